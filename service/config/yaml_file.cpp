// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/config/yaml_file.hpp"

#include <yaml-cpp/eventhandler.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>
#include <system_error>

#include "service/config/config_error.hpp"

namespace graspd {
namespace {

std::string read_text(const std::filesystem::path& file) {
  const ConfigPlace place{file.string(), ""};
  std::error_code error;
  // A folder or a device opens too, and a device may never end.
  const auto status = std::filesystem::status(file, error);
  if (status.type() == std::filesystem::file_type::not_found) place.fail("no such file", "", "");
  if (error) place.fail("cannot be read: " + error.message(), "", "");
  if (status.type() != std::filesystem::file_type::regular) place.fail("not a regular file", "", "");
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) place.fail(std::string("cannot be read: ") + std::strerror(errno), "", "");
  std::string text(kMaxConfigBytes + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream.bad()) place.fail(std::string("cannot be read: ") + std::strerror(errno), "", "");
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() > kMaxConfigBytes)
    place.fail("too large for a configuration", "more than " + std::to_string(kMaxConfigBytes) + " bytes",
               "at most " + std::to_string(kMaxConfigBytes) + " bytes");
  return text;
}

/// Bytes of the sequence that the lead byte begins, with the smallest code point that may be written so long.
struct Utf8Lead {
  int length;
  std::uint32_t bits;
  std::uint32_t smallest;
};

Utf8Lead utf8_lead(unsigned char c) {
  if (c < 0x80) return {1, c, 0};
  if (c >= 0xc2 && c < 0xe0) return {2, c & 0x1fu, 0x80};
  if (c >= 0xe0 && c < 0xf0) return {3, c & 0x0fu, 0x800};
  if (c >= 0xf0 && c < 0xf5) return {4, c & 0x07u, 0x10000};
  return {0, 0, 0};
}

/// What a document is made of, before there is memory for it: yaml-cpp's own tree has no limits, and its
/// LoadAll never ends on some texts that are no YAML (a comma at the start).
class DocumentLimits : public YAML::EventHandler {
 public:
  explicit DocumentLimits(const ConfigPlace& place) : place_(place) {}

  void OnDocumentStart(const YAML::Mark&) override {
    if (++documents_ > 1) place_.fail("more than one document", "", "1");
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override { count(); }
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override { count(); }
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t, const std::string&) override {
    count();
  }
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    enter();
  }
  void OnSequenceEnd() override { --depth_; }
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
    enter();
  }
  void OnMapEnd() override { --depth_; }

 private:
  void count() {
    if (++nodes_ > kMaxConfigNodes)
      place_.fail("too many values", "", "at most " + std::to_string(kMaxConfigNodes));
  }
  void enter() {
    count();
    if (++depth_ > kMaxConfigDepth)
      place_.fail("too many levels", "", "at most " + std::to_string(kMaxConfigDepth));
  }

  const ConfigPlace& place_;
  std::size_t documents_ = 0;
  std::size_t nodes_ = 0;
  std::size_t depth_ = 0;
};

void check_limits(const std::string& text, const ConfigPlace& place) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  DocumentLimits limits(place);
  while (parser.HandleNextDocument(limits)) {
  }
}

}  // namespace

bool is_utf8_text(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const Utf8Lead lead = utf8_lead(static_cast<unsigned char>(text[i]));
    const auto length = static_cast<std::size_t>(lead.length);
    if (length == 0 || i + length > text.size() || text[i] == '\0') return false;
    std::uint32_t point = lead.bits;
    for (std::size_t k = 1; k < length; ++k) {
      const auto c = static_cast<unsigned char>(text[i + k]);
      if ((c & 0xc0u) != 0x80u) return false;
      point = (point << 6) | (c & 0x3fu);
    }
    if (point < lead.smallest || point > 0x10ffff || (point >= 0xd800 && point < 0xe000)) return false;
    i += length;
  }
  return true;
}

YAML::Node load_yaml(const std::filesystem::path& file) {
  return parse_yaml(read_text(file), ConfigPlace{file.string(), ""});
}

YAML::Node parse_yaml(const std::string& text, const ConfigPlace& place) {
  if (!is_utf8_text(text)) place.fail("not a text file", "bytes that are not UTF-8", "YAML in UTF-8");
  try {
    check_limits(text, place);
    return YAML::Load(text);
  } catch (const YAML::Exception& e) {
    place.fail("line " + std::to_string(e.mark.line + 1) + ", column " + std::to_string(e.mark.column + 1) +
                   ": not YAML: " + e.msg,
               "", "");
  }
}

}  // namespace graspd

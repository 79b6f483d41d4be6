// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/common/pcd_header.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <stdexcept>

#include "client/common/text.hpp"

namespace graspd {
namespace {

constexpr std::size_t kMaxPoints = 100'000'000;
constexpr std::size_t kMaxPointBytes = 65'536;

using Words = std::vector<std::string_view>;
using Entries = std::map<std::string_view, Words>;

[[noreturn]] void fail(const std::string& reason) {
  throw std::runtime_error("the PCD header " + reason);
}

/// All lines up to DATA, which is the last one; moves `at` behind it.
Entries read_entries(std::string_view file, std::size_t& at) {
  Entries entries;
  while (true) {
    const auto end = file.find('\n', at);
    if (end == file.npos) fail("has no DATA line");
    const Words words = split_words(file.substr(at, end - at));
    at = end + 1;
    if (words.empty() || words[0].starts_with('#')) continue;
    entries[words[0]] = {words.begin() + 1, words.end()};
    if (words[0] == "DATA") return entries;
  }
}

const Words& entry(const Entries& entries, const char* key) {
  const auto found = entries.find(key);
  if (found == entries.end() || found->second.empty()) fail(std::string("has no ") + key);
  return found->second;
}

template <class T>
std::optional<T> parse(std::string_view word) {
  T value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

std::size_t count_of(const Entries& entries, const char* key) {
  const std::string_view word = entry(entries, key)[0];
  const auto value = parse<std::size_t>(word);
  if (!value) fail(std::string("gives ") + key + " as '" + plain_line(word) + "', expected a count");
  if (*value > kMaxPoints) fail("promises too many points");
  return *value;
}

PcdField field(std::string_view name, std::string_view size, std::string_view type, std::string_view count) {
  const auto size_value = parse<std::size_t>(size);
  const auto count_value = parse<std::size_t>(count);
  const bool known_size =
      size_value && (*size_value == 1 || *size_value == 2 || *size_value == 4 || *size_value == 8);
  const bool known_type = type == "I" || type == "U" || (type == "F" && known_size && *size_value >= 4);
  const bool known_count = count_value && *count_value >= 1 && *count_value <= kMaxPointBytes;
  if (!known_size || !known_type || !known_count) {
    fail("gives the field " + plain_line(name) + " an impossible size, type or count");
  }
  return {std::string(name), type[0], *size_value, *count_value, 0, 0};
}

void read_fields(const Entries& entries, PcdHeader& header) {
  const Words& names = entry(entries, "FIELDS");
  const Words& sizes = entry(entries, "SIZE");
  const Words& types = entry(entries, "TYPE");
  const Words counts = entries.contains("COUNT") ? entry(entries, "COUNT") : Words(names.size(), "1");
  if (sizes.size() != names.size() || types.size() != names.size() || counts.size() != names.size()) {
    fail("has FIELDS, SIZE, TYPE and COUNT of different lengths");
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    PcdField& next = header.fields.emplace_back(field(names[i], sizes[i], types[i], counts[i]));
    next.offset = header.point_bytes;
    next.index = header.point_elements;
    header.point_bytes += next.size * next.count;
    header.point_elements += next.count;
    if (header.point_bytes > kMaxPointBytes) fail("has points of more than 64 KiB");
  }
}

void read_viewpoint(const Entries& entries, PcdHeader& header) {
  if (!entries.contains("VIEWPOINT")) return;
  const Words& words = entry(entries, "VIEWPOINT");
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto value = axis < words.size() ? parse<float>(words[axis]) : std::nullopt;
    if (!value || !(std::abs(*value) < 1e6f)) fail("has a VIEWPOINT that is no place");
    header.viewpoint[static_cast<Eigen::Index>(axis)] = *value;
  }
}

}  // namespace

const PcdField* PcdHeader::find(std::string_view name) const {
  for (const PcdField& candidate : fields) {
    if (candidate.name == name) return &candidate;
  }
  return nullptr;
}

PcdHeader parse_pcd_header(std::string_view file) {
  PcdHeader header;
  const Entries entries = read_entries(file, header.data_start);
  read_fields(entries, header);
  header.width = count_of(entries, "WIDTH");
  header.height = count_of(entries, "HEIGHT");
  const std::size_t points = entries.contains("POINTS") ? count_of(entries, "POINTS") : header.points();
  if (header.points() > kMaxPoints) fail("promises too many points");
  if (points != header.points()) {
    fail("gives POINTS as " + std::to_string(points) + ", expected WIDTH " + std::to_string(header.width) +
         " x HEIGHT " + std::to_string(header.height));
  }
  read_viewpoint(entries, header);
  const std::string kind(entry(entries, "DATA")[0]);
  if (kind == "ascii") {
    header.data = PcdData::kAscii;
  } else if (kind == "binary") {
    header.data = PcdData::kBinary;
  } else if (kind == "binary_compressed") {
    header.data = PcdData::kCompressed;
  } else {
    fail("gives DATA as '" + plain_line(kind) + "', expected ascii, binary or binary_compressed");
  }
  return header;
}

}  // namespace graspd

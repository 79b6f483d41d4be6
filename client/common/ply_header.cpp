// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/common/ply_header.hpp"

#include <array>
#include <charconv>
#include <optional>
#include <stdexcept>
#include <utility>

#include "client/common/text.hpp"

namespace graspd {
namespace {

constexpr std::size_t kMaxElements = 100'000'000;

using Words = std::vector<std::string_view>;

[[noreturn]] void fail(const std::string& reason) {
  throw std::runtime_error("the PLY header " + reason);
}

PlyType type_of(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, PlyType>, 16> kTypes{{{"char", PlyType::kInt8},
                                                                         {"int8", PlyType::kInt8},
                                                                         {"uchar", PlyType::kUint8},
                                                                         {"uint8", PlyType::kUint8},
                                                                         {"short", PlyType::kInt16},
                                                                         {"int16", PlyType::kInt16},
                                                                         {"ushort", PlyType::kUint16},
                                                                         {"uint16", PlyType::kUint16},
                                                                         {"int", PlyType::kInt32},
                                                                         {"int32", PlyType::kInt32},
                                                                         {"uint", PlyType::kUint32},
                                                                         {"uint32", PlyType::kUint32},
                                                                         {"float", PlyType::kFloat32},
                                                                         {"float32", PlyType::kFloat32},
                                                                         {"double", PlyType::kFloat64},
                                                                         {"float64", PlyType::kFloat64}}};
  for (const auto& [known, type] : kTypes) {
    if (known == name) return type;
  }
  fail("has the type '" + plain_line(name) + "'");
}

PlyFormat format_of(const Words& words) {
  const std::string name(words.size() > 1 ? words[1] : "");
  if (name == "ascii") return PlyFormat::kAscii;
  if (name == "binary_little_endian") return PlyFormat::kLittleEndian;
  if (name == "binary_big_endian") return PlyFormat::kBigEndian;
  fail("gives the format as '" + plain_line(name) + "'");
}

PlyElement element_of(const Words& words) {
  if (words.size() != 3) fail("has an element without name and count");
  PlyElement element{std::string(words[1]), 0, {}};
  const auto [end, error] =
      std::from_chars(words[2].data(), words[2].data() + words[2].size(), element.count);
  if (error != std::errc() || end != words[2].data() + words[2].size() || element.count > kMaxElements) {
    fail("promises '" + plain_line(words[2]) + "' of " + plain_line(words[1]));
  }
  return element;
}

PlyProperty property_of(const Words& words) {
  if (words.size() == 3) return {std::string(words[2]), type_of(words[1]), false, PlyType::kUint8};
  if (words.size() != 5 || words[1] != "list") fail("has a property without type and name");
  const PlyType count = type_of(words[2]);
  if (count == PlyType::kFloat32 || count == PlyType::kFloat64) fail("counts a list in floating point");
  return {std::string(words[4]), type_of(words[3]), true, count};
}

}  // namespace

std::size_t size_of(PlyType type) {
  constexpr std::array<std::size_t, 8> kSizes{1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

std::size_t PlyElement::least_bytes(PlyFormat format) const {
  std::size_t bytes = 0;
  for (const PlyProperty& p : properties) {
    // As text a digit and a separator.
    bytes += format == PlyFormat::kAscii ? 2 : size_of(p.is_list ? p.count_type : p.type);
  }
  return bytes;
}

PlyHeader parse_ply_header(std::string_view file) {
  PlyHeader header;
  std::optional<PlyFormat> format;
  while (true) {
    const auto end = file.find('\n', header.data_start);
    if (end == file.npos) fail("has no end_header line");
    const Words words = split_words(file.substr(header.data_start, end - header.data_start));
    header.data_start = end + 1;
    if (words.empty() || words[0] == "ply" || words[0] == "comment" || words[0] == "obj_info") continue;
    if (words[0] == "end_header") break;
    if (words[0] == "format") {
      format = format_of(words);
    } else if (words[0] == "element") {
      header.elements.push_back(element_of(words));
    } else if (words[0] == "property" && !header.elements.empty()) {
      header.elements.back().properties.push_back(property_of(words));
    } else {
      fail("has a line '" + plain_line(words[0]) + "'");
    }
  }
  if (!format) fail("has no format");
  header.format = *format;
  return header;
}

}  // namespace graspd

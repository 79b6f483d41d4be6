// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The header of a PLY file.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace graspd {

enum class PlyFormat { kAscii, kLittleEndian, kBigEndian };
enum class PlyType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };
[[nodiscard]] std::size_t size_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kFloat32;
  bool is_list = false;
  PlyType count_type = PlyType::kUint8;  ///< of a list
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;  ///< up to 10^8
  std::vector<PlyProperty> properties;

  /// The fewest bytes that one takes.
  [[nodiscard]] std::size_t least_bytes(PlyFormat format) const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::kAscii;
  std::vector<PlyElement> elements;
  std::size_t data_start = 0;  ///< from the start of the file [bytes]
};

/// Throws std::runtime_error that says what is wrong.
[[nodiscard]] PlyHeader parse_ply_header(std::string_view file);

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The header of a PCD file.
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace graspd {

enum class PcdData { kAscii, kBinary, kCompressed };

struct PcdField {
  std::string name;
  char type = 'F';         ///< F, I or U
  std::size_t size = 4;    ///< of one element [bytes]
  std::size_t count = 1;   ///< elements
  std::size_t offset = 0;  ///< from the start of a point [bytes]
  std::size_t index = 0;   ///< of its first element among the elements of a point
};

/// Holds only values that agree with each other; points may be up to 10^8, a point up to 64 KiB.
struct PcdHeader {
  std::vector<PcdField> fields;
  std::size_t width = 0;
  std::size_t height = 0;
  Eigen::Vector3f viewpoint = Eigen::Vector3f::Zero();
  PcdData data = PcdData::kAscii;
  std::size_t data_start = 0;  ///< from the start of the file [bytes]
  std::size_t point_bytes = 0;
  std::size_t point_elements = 0;

  [[nodiscard]] std::size_t points() const { return width * height; }
  [[nodiscard]] const PcdField* find(std::string_view name) const;  ///< null: there is none
};

/// Throws std::runtime_error that says what is wrong.
[[nodiscard]] PcdHeader parse_pcd_header(std::string_view file);

}  // namespace graspd

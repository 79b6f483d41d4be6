// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Clouds in types of others, encoded by those types' generated code.
#pragma once
#include <string>
#include <vector>

#include "tests/unit/transport/message_samples.hpp"

namespace graspd {

/// What Drake's, bot_core's and dimos's packed clouds have in common.
struct ForeignCloud {
  struct Field {
    std::string name;
    int offset = 0;
    int datatype = 0;
    int count = 0;
  };
  std::int64_t utime = 1'000'004;
  int seq = 9;
  std::string frame_name = "lidar";
  int width = 1;
  int height = 1;
  std::vector<Field> fields;
  bool big_endian = false;
  int point_step = 0;
  int row_step = 0;
  std::vector<std::uint8_t> data;

  /// In both orders of bytes and both datatypes. Bytes of the point at (row, column) must be there.
  [[nodiscard]] float coordinate(int row, int column, const std::string& name) const;
  /// Coordinates of every datatype, at any place.
  void set_coordinate(int row, int column, const std::string& name, double value);

 private:
  [[nodiscard]] const Field& field(const std::string& name) const;
  [[nodiscard]] std::size_t place(int row, int column, const Field& field) const;
};

/// One point, to be spoilt.
[[nodiscard]] ForeignCloud small_foreign_cloud();
/// Both orders of bytes, FLOAT32 and FLOAT64, other fields of any datatype and count, gaps after fields,
/// points and rows, organized or not, sometimes empty.
[[nodiscard]] ForeignCloud random_foreign_cloud(Random& random, int max_side);

/// The first has no sequence number.
[[nodiscard]] Bytes as_lcmt_point_cloud(const ForeignCloud& cloud);
[[nodiscard]] Bytes as_pointcloud2(const ForeignCloud& cloud);
[[nodiscard]] Bytes as_sensor_msgs(const ForeignCloud& cloud);
/// Of x, y and z alone, in one row; with two channels.
[[nodiscard]] Bytes as_pointcloud(const ForeignCloud& cloud);

}  // namespace graspd

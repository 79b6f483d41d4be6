// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// One point for each occupied voxel: the mean of the points in it.
#pragma once
#include <cstdint>
#include <vector>

#include "service/pipeline/config_fields.hpp"
#include "service/pipeline/point_cloud.hpp"

namespace graspd {

struct DownsampleConfig {
  float leaf_size_m = 0.003f;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& v) {
    v("leaf_size_m", self.leaf_size_m, Range{0.0005, 0.1}, "edge of a voxel [m]; one point is kept for each");
  }
};

struct Downsampled {
  PointCloud cloud;                           ///< one point a voxel, row by row of voxels, unorganized
  std::vector<std::uint32_t> voxel_of_point;  ///< for each input point the index of its voxel's point
};

/// All points must be finite.
[[nodiscard]] Downsampled downsample(const PointCloud& cloud, const DownsampleConfig& config);

}  // namespace graspd

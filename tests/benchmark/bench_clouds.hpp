// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The clouds that are timed: files, or a scene made here.
#pragma once
#include <string>
#include <vector>

#include "service/pipeline/point_cloud.hpp"

namespace graspd {

struct BenchCloud {
  std::string name;
  PointCloud cloud;
};

/// From files and folders; without any, nine objects on 1 m x 0.9 m of a table as a VGA camera sees them,
/// with noise. leaf_m: one point a voxel, unorganized, as over a thin line; 0 keeps every point.
[[nodiscard]] std::vector<BenchCloud> bench_clouds(const std::vector<std::string>& arguments, float leaf_m);

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The first half of the method as PCL has it: normals over a radius, then its region growing.
#pragma once
#include "service/pipeline/point_cloud.hpp"

namespace graspd {

struct PclTimes {
  double normals_ms = 0;
  double region_growing_ms = 0;
  int num_regions = 0;

  [[nodiscard]] double total_ms() const { return normals_ms + region_growing_ms; }
};

/// NormalEstimationOMP on that many threads, then RegionGrowing (30 neighbours, which it finds itself), on
/// the finite points of the cloud. Making the pcl::PointCloud is not counted.
[[nodiscard]] PclTimes run_pcl(const PointCloud& cloud, float radius_m, float max_angle_deg, int threads);

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Segments: the surfaces that are large enough to hold, with their principal axes (paper, section 5).
#pragma once
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "service/pipeline/config_fields.hpp"
#include "service/pipeline/point_cloud.hpp"
#include "service/pipeline/region_growing.hpp"

namespace graspd {

struct SegmentsConfig {
  float min_area_m2 = 3.6e-4f;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& v) {
    v("min_area_m2", self.min_area_m2, Range{0, 1},
      "smaller surfaces are obstacles only [m2]; 3.6e-4 is 40 voxels of 3 mm");
  }
};

struct Segment {
  std::pmr::vector<std::uint32_t> points;  ///< indices into the cloud, ascending
  Eigen::Vector3f centroid = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();  ///< n: smallest principal axis, towards the sensor
  Eigen::Vector3f major = Eigen::Vector3f::UnitX();   ///< a: largest principal axis
  Eigen::Vector3f minor = Eigen::Vector3f::UnitY();   ///< f = n x a; a, f, n are right-handed
  float scatter_m = 0;  ///< root mean square distance of its points from their plane
};

struct Segments {
  std::pmr::vector<Segment> list;
  std::pmr::vector<std::int32_t> of_point;  ///< index into list for each point; -1: in no segment
};

/// leaf_size_m: of the voxels, to turn the area into a number of points.
[[nodiscard]] Segments build_segments(const PointCloud& cloud, const Labels& labels, float leaf_size_m,
                                      const SegmentsConfig& config);

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The plane that objects stand on, where there is one.
#pragma once
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <vector>

#include "service/pipeline/config_fields.hpp"
#include "service/pipeline/level.hpp"
#include "service/pipeline/plane.hpp"
#include "service/pipeline/point_cloud.hpp"

namespace graspd {

struct SupportConfig {
  bool enabled = true;
  float min_area_m2 = 0.03f;
  float min_upper_area_m2 = 0.12f;
  float min_level_area_m2 = 0.05f;
  float min_level_width_m = 0.2f;
  float thickness_m = 0.008f;
  float min_thickness_m = 0.005f;
  float thickness_per_m = 0.006f;
  float max_normal_angle_deg = 25.0f;
  int hypotheses = 200;
  float leaf_size_m = 0.012f;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& v) {
    v("enabled", self.enabled, Range{}, "look for the plane that objects stand on");
    v("min_area_m2", self.min_area_m2, Range{0.001, 100},
      "smallest visible area of a support with things on it; four times as much without [m2]");
    v("min_upper_area_m2", self.min_upper_area_m2, Range{0.001, 100},
      "a parallel plane above the largest one with this connected area is the support: a table over the "
      "floor [m2]");
    v("min_level_area_m2", self.min_level_area_m2, Range{0.001, 100},
      "parallel planes above and below it with this connected area and things on them are supports, too "
      "[m2]");
    v("min_level_width_m", self.min_level_width_m, Range{0.01, 10}, "and as wide as this [m]");
    v("thickness_m", self.thickness_m, Range{0.001, 0.1},
      "points this close to a plane are its own while the support is looked for [m]");
    v("min_thickness_m", self.min_thickness_m, Range{0.001, 0.1},
      "points this close to the support belong to it, and up to 3.5 times as far as they scatter [m]");
    v("thickness_per_m", self.thickness_per_m, Range{0, 0.1},
      "more for each metre beyond 0.8 m from the sensor [m]");
    v("max_normal_angle_deg", self.max_normal_angle_deg, Range{1, 89},
      "between a point's normal and the plane's [degrees]");
    v("hypotheses", self.hypotheses, Range{10, 10000}, "planes tried by RANSAC");
    v("leaf_size_m", self.leaf_size_m, Range{0.002, 0.2},
      "voxels of the coarser copy that the plane is looked for in [m]");
  }
};

struct Support {
  Plane plane;
  float sigma_m = 0;  ///< scatter of its points about the plane
  /// 1 for each point that belongs to the plane, or to one of the levels, or lies below all of them.
  std::pmr::vector<std::uint8_t> is_support;
  /// Where things stand at several heights: all of them, the plane, too, the lowest first. Else empty.
  std::pmr::vector<Level> levels;

  [[nodiscard]] const Plane& lowest_plane() const { return levels.empty() ? plane : levels.front().plane; }
};

/// RANSAC over points and normals of a coarser copy of the cloud, then least squares. It comes before the
/// surfaces, because most points of most frames are the support's and need no neighbourhood of their own. The
/// same cloud gives the same plane: the random numbers are seeded by a constant.
[[nodiscard]] std::optional<Support> find_support(const PointCloud& cloud, const SupportConfig& config);

/// How far from the plane points at p still count as its own [m].
[[nodiscard]] float support_thickness(const Eigen::Vector3f& p, const Eigen::Vector3f& viewpoint,
                                      float sigma_m, const SupportConfig& config);

}  // namespace graspd

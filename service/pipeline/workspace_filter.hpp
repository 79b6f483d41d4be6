// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Keeps the finite points inside the workspace.
#pragma once
#include <Eigen/Geometry>
#include <optional>

#include "service/pipeline/config_fields.hpp"
#include "service/pipeline/pinhole_fit.hpp"
#include "service/pipeline/point_cloud.hpp"

namespace graspd {

/// A box in the frame that handles are published in (the robot's when extrinsics are given, else the
/// cloud's), and a range.
struct WorkspaceFilterConfig {
  Eigen::Vector3f min_m{-10, -10, -10};
  Eigen::Vector3f max_m{10, 10, 10};
  float min_range_m = 0.05f;
  float max_range_m = 4.0f;
  /// Takes points of the cloud to the frame of the box; set from the source's extrinsics.
  Eigen::Isometry3f T_box_cloud = Eigen::Isometry3f::Identity();

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& v) {
    v("min_m", self.min_m, Range{-1000, 1000},
      "smallest x, y, z [m], in the frame that handles are published in");
    v("max_m", self.max_m, Range{-1000, 1000}, "largest x, y, z [m]");
    v("min_range_m", self.min_range_m, Range{0, 100}, "smallest distance from the sensor [m]");
    v("max_range_m", self.max_range_m, Range{0, 100}, "largest distance from the sensor [m]");
  }

  /// min_m below max_m on each axis, min_range_m below max_range_m.
  [[nodiscard]] std::optional<ConfigProblem> validate() const;
};

/// The points that are left, unorganized, in the order of the cloud.
struct WorkspaceResult {
  PointCloud cloud;
  ImagePixels pixels;          ///< of these points, where the input is organized
  std::size_t num_finite = 0;  ///< of the input
};

[[nodiscard]] WorkspaceResult filter_workspace(const PointCloud& cloud, const WorkspaceFilterConfig& config);

}  // namespace graspd

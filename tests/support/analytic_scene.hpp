// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Scenes of analytic solids as an ideal depth camera sees them.
#pragma once
#include <Eigen/Geometry>
#include <vector>

#include "service/pipeline/point_cloud.hpp"
#include "tests/support/analytic_solid.hpp"

namespace graspd {

/// A pinhole that looks along its z axis, x to the right and y down, with the principal point in the middle.
struct AnalyticCamera {
  Eigen::Isometry3d T_scene_camera = Eigen::Isometry3d::Identity();
  int width = 320;
  int height = 240;
  double focal_px = 500;
};

/// Upright as far as z is up in the scene.
[[nodiscard]] Eigen::Isometry3d looking_at(const Eigen::Vector3d& eye, const Eigen::Vector3d& target);

struct AnalyticScene {
  std::vector<AnalyticSolid> solids;
  AnalyticCamera camera;
};

/// One depth frame in the scene's frame, organized; NaN where a ray meets nothing.
struct RenderedScene {
  PointCloud cloud;
  std::vector<int> solid_of_point;  ///< -1: nothing
};

[[nodiscard]] RenderedScene render(const AnalyticScene& scene);

/// All solids and the camera moved by T.
[[nodiscard]] AnalyticScene moved(const AnalyticScene& scene, const Eigen::Isometry3d& T);

}  // namespace graspd

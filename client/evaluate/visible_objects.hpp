// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What a camera sees of each object of a scene.
#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "client/simulate/depth_camera.hpp"
#include "client/simulate/scene.hpp"

namespace graspd {

/// A place on the visible surface, in the world frame.
struct SurfaceSpot {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< out of the solid, unit length
};

struct VisibleObject {
  std::size_t solid = 0;  ///< index into the scene
  int pixels = 0;
  double surface_m2 = 0;           ///< that the camera sees; what it sees at a grazing angle counts less
  std::vector<SurfaceSpot> spots;  ///< spread over it, one in each cube of spot_spacing_m
};

/// Those with at least a pixel, in the order of the scene. frame: what an ideal camera sees of the scene.
[[nodiscard]] std::vector<VisibleObject> visible_objects(const Scene& scene, const DepthFrame& frame,
                                                         const Eigen::Isometry3d& T_world_camera,
                                                         double spot_spacing_m);

}  // namespace graspd

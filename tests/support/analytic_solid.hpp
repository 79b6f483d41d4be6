// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Convex solids with exact answers: where a line crosses them, and how far a point is from them.
#pragma once
#include <Eigen/Geometry>
#include <optional>

namespace graspd {

enum class SolidShape {
  kBox,        ///< half.x, half.y, half.z: half the edges [m]
  kCylinder,   ///< half.x: radius, half.z: half the height, along z [m]
  kSphere,     ///< half.x: radius [m]
  kHalfSpace,  ///< z <= 0
};

struct AnalyticSolid {
  SolidShape shape = SolidShape::kBox;
  Eigen::Vector3d half = Eigen::Vector3d::Ones();
  Eigen::Isometry3d T_scene_solid = Eigen::Isometry3d::Identity();
};

/// Distances along a line between which it is inside; either may be infinite [units of the direction].
struct Chord {
  double enter = 0, leave = 0;
};

[[nodiscard]] std::optional<Chord> intersect(const AnalyticSolid& solid, const Eigen::Vector3d& origin,
                                             const Eigen::Vector3d& direction);

/// Negative inside [m].
[[nodiscard]] double signed_distance(const AnalyticSolid& solid, const Eigen::Vector3d& point);

}  // namespace graspd

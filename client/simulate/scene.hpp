// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Solids in a world frame (z up): what a simulated camera looks at, and the truth about where matter is.
#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "client/simulate/convex.hpp"

namespace graspd {

/// Labels of points, in the convention of the mOSD data set.
inline constexpr std::uint32_t kLabelInvalid = 0;  ///< not measured, or belongs to nothing
inline constexpr std::uint32_t kLabelSupport = 1;  ///< what objects stand on
inline constexpr std::uint32_t kLabelBinWall = 2;
inline constexpr std::uint32_t kFirstObject = 2;  ///< objects are numbered from here
[[nodiscard]] constexpr std::uint32_t object_label(std::uint32_t object) {
  return 10 * object;
}

/// A rigid body: the union of its parts, less the cavity.
struct Solid {
  std::string kind;  ///< lower_snake: box, mug, table, ...
  std::uint32_t label = kLabelInvalid;
  std::uint32_t rgb = 0x808080;  ///< 0x00RRGGBB
  std::vector<Convex> parts;     ///< in the solid's frame
  std::optional<Convex> cavity;  ///< in the solid's frame
  Eigen::Isometry3d T_world_solid = Eigen::Isometry3d::Identity();
};

struct Scene {
  std::vector<Solid> solids;
};

/// The first point of a part, outside the cavity, that the ray reaches at t > 0; all in the solid's frame.
[[nodiscard]] std::optional<Crossing> first_crossing(const Convex& part, const std::optional<Convex>& cavity,
                                                     const Ray& ray);

/// What a ray meets first of one solid; ray and crossing in the solid's frame.
[[nodiscard]] std::optional<Crossing> cast_in_solid(const Solid& solid, const Ray& ray);

/// What a ray meets first.
struct Hit {
  double t = 0;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< out of the solid, unit length, in the world frame
  std::size_t solid = 0;                             ///< index into the scene
};

[[nodiscard]] std::optional<Hit> cast(const Scene& scene, const Ray& ray);

/// Negative inside matter. The sign is exact; the amount is never more than the true distance to the surface,
/// and differs between two points by no more than their distance.
[[nodiscard]] double signed_distance(const Solid& solid, const Eigen::Vector3d& point_world);

/// The same for a point in the solid's frame.
[[nodiscard]] double signed_distance_in_solid(const Solid& solid, const Eigen::Vector3d& point);

/// The nearest solid's; infinite in an empty scene.
[[nodiscard]] double signed_distance(const Scene& scene, const Eigen::Vector3d& point_world);

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/simulate/scene.hpp"

#include <algorithm>
#include <limits>

namespace graspd {

std::optional<Crossing> first_crossing(const Convex& part, const std::optional<Convex>& cavity,
                                       const Ray& ray) {
  const auto inside = intersect(part, ray);
  if (!inside || inside->leave.t <= 0) return std::nullopt;
  const auto hole = cavity ? intersect(*cavity, ray) : std::nullopt;
  const bool enters_matter = !hole || inside->enter.t < hole->enter.t || inside->enter.t >= hole->leave.t;
  if (enters_matter && inside->enter.t > 0) return inside->enter;
  // The far side of the cavity, seen from within it: its outside is the matter's inside.
  if (hole && hole->leave.t > 0 && hole->leave.t > inside->enter.t && hole->leave.t < inside->leave.t) {
    return Crossing{hole->leave.t, -hole->leave.normal};
  }
  return std::nullopt;
}

std::optional<Crossing> cast_in_solid(const Solid& solid, const Ray& ray) {
  std::optional<Crossing> best;
  for (const Convex& part : solid.parts) {
    const auto crossing = first_crossing(part, solid.cavity, ray);
    if (crossing && (!best || crossing->t < best->t)) best = crossing;
  }
  return best;
}

std::optional<Hit> cast(const Scene& scene, const Ray& ray) {
  std::optional<Hit> best;
  for (std::size_t i = 0; i < scene.solids.size(); ++i) {
    const Solid& solid = scene.solids[i];
    const Eigen::Matrix3d R_solid_world = solid.T_world_solid.linear().transpose();
    const Ray local{R_solid_world * (ray.origin - solid.T_world_solid.translation()),
                    R_solid_world * ray.direction};
    const auto crossing = cast_in_solid(solid, local);
    if (crossing && (!best || crossing->t < best->t))
      best = Hit{crossing->t, solid.T_world_solid.linear() * crossing->normal, i};
  }
  return best;
}

double signed_distance(const Solid& solid, const Eigen::Vector3d& point_world) {
  return signed_distance_in_solid(solid, solid.T_world_solid.inverse() * point_world);
}

double signed_distance_in_solid(const Solid& solid, const Eigen::Vector3d& point) {
  double distance = std::numeric_limits<double>::infinity();
  for (const Convex& part : solid.parts) distance = std::min(distance, signed_distance(part, point));
  if (solid.cavity) distance = std::max(distance, -signed_distance(*solid.cavity, point));
  return distance;
}

double signed_distance(const Scene& scene, const Eigen::Vector3d& point_world) {
  double distance = std::numeric_limits<double>::infinity();
  for (const Solid& solid : scene.solids) distance = std::min(distance, signed_distance(solid, point_world));
  return distance;
}

}  // namespace graspd

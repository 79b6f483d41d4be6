// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/simulate/drop.hpp"

#include <algorithm>

#include "client/simulate/cell_search.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;

constexpr double kFinest = 4e-4;
constexpr double kRounding = 1e-6;

Eigen::AlignedBox3d bounds_of(const Solid& solid) {
  Eigen::AlignedBox3d box;
  for (const Convex& part : solid.parts) box.extend(bounds(part));
  return box;
}

bool free_at(const Scene& scene, const Solid& object, double height) {
  Solid moved = object;
  moved.T_world_solid.pretranslate(Vector3d(0, 0, height));
  return std::none_of(scene.solids.begin(), scene.solids.end(),
                      [&](const Solid& other) { return overlap(moved, other); });
}

}  // namespace

bool overlap(const Solid& a, const Solid& b) {
  const Eigen::AlignedBox3d box = bounds_of(a);
  const Eigen::Isometry3d T_b_a = b.T_world_solid.inverse() * a.T_world_solid;
  // The common part of two solids: it, too, changes no faster than distance does.
  const auto common = [&](const Vector3d& p) {
    return std::max(signed_distance_in_solid(a, p), signed_distance_in_solid(b, T_b_a * p));
  };
  return falls_below(common, box, -kRounding, kFinest);
}

std::optional<Eigen::Isometry3d> lowered(const Scene& scene, const Solid& object, double drop_m) {
  if (!free_at(scene, object, 0)) return std::nullopt;
  constexpr double kStep = 0.004;  // Less than the thinnest object, so that nothing is passed through.
  double free = 0, blocked = -drop_m;
  while (free > -drop_m) {
    const double next = std::max(free - kStep, -drop_m);
    if (!free_at(scene, object, next)) {
      blocked = next;
      break;
    }
    free = next;
  }
  for (int i = 0; i < 5; ++i) {
    const double middle = 0.5 * (free + blocked);
    (free_at(scene, object, middle) ? free : blocked) = middle;
  }
  Eigen::Isometry3d T = object.T_world_solid;
  // What the test for overlaps cannot see is made up for.
  T.pretranslate(Vector3d(0, 0, free + kFinest));
  return T;
}

}  // namespace graspd

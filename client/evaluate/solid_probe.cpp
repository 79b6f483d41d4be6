// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/solid_probe.hpp"

#include <algorithm>
#include <cmath>

#include "client/simulate/cell_search.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;

/// A grid over the face; spots are the middles of its cells.
struct Grid {
  int across, deep;  // along x and z
  Vector3d first, step_x, step_z;

  explicit Grid(const PadSweep& sweep) {
    const Vector3d size = sweep.face.sizes();
    across = std::max(1, static_cast<int>(std::lround(size.x() / sweep.spacing_m)));
    deep = std::max(1, static_cast<int>(std::lround(size.z() / sweep.spacing_m)));
    step_x = Vector3d(size.x() / across, 0, 0);
    step_z = Vector3d(0, 0, size.z() / deep);
    first = sweep.face.min() + 0.5 * (step_x + step_z);
  }

  [[nodiscard]] Vector3d at(int row, int column) const { return first + column * step_x + row * step_z; }
};

void sweep_over(const Solid& solid, std::size_t index, const Eigen::Isometry3d& T_solid_hand,
                const PadSweep& sweep, std::vector<PadHit>& hits) {
  const Grid grid(sweep);
  Ray ray;
  ray.direction = sweep.direction * T_solid_hand.linear().col(1);
  for (int row = 0; row < grid.deep; ++row) {
    for (int column = 0; column < grid.across; ++column) {
      const Vector3d start = grid.at(row, column);
      ray.origin = T_solid_hand * start;
      const auto crossing = cast_in_solid(solid, ray);
      PadHit& hit = hits[static_cast<std::size_t>(row * grid.across + column)];
      if (!crossing || crossing->t >= std::min(hit.travel_m, sweep.reach_m)) continue;
      hit = {crossing->t, index, start + crossing->t * sweep.direction * Vector3d::UnitY(),
             T_solid_hand.linear().transpose() * crossing->normal};
    }
  }
}

}  // namespace

SolidProbe::SolidProbe(const Scene& scene) : scene_(&scene) {
  for (const Solid& solid : scene.solids) {
    Eigen::AlignedBox3d box;
    for (const Convex& part : solid.parts) box.extend(bounds(part));
    center_.push_back(solid.T_world_solid * box.center());
    radius_.push_back(0.5 * box.diagonal().norm());
  }
}

std::vector<std::size_t> SolidProbe::near(const Eigen::Isometry3d& T_world_hand,
                                          const Eigen::AlignedBox3d& box) const {
  const Vector3d center = T_world_hand * box.center();
  const double radius = 0.5 * box.diagonal().norm();
  std::vector<std::size_t> solids;
  for (std::size_t i = 0; i < center_.size(); ++i) {
    const double apart = radius + radius_[i];
    if ((center_[i] - center).squaredNorm() > apart * apart) continue;
    if (signed_distance(scene_->solids[i], center) <= radius) solids.push_back(i);
  }
  return solids;
}

bool reaches_into(const Solid& solid, const Eigen::Isometry3d& T_solid_box, const Eigen::AlignedBox3d& box,
                  double depth_m) {
  constexpr double kFinest = 2.5e-4;
  const auto distance = [&](const Vector3d& p) { return signed_distance_in_solid(solid, T_solid_box * p); };
  return falls_below(distance, box, -depth_m, kFinest);
}

std::vector<PadHit> sweep_pad(const Scene& scene, std::span<const std::size_t> solids,
                              const Eigen::Isometry3d& T_world_hand, const PadSweep& sweep) {
  const Grid grid(sweep);
  std::vector<PadHit> hits(static_cast<std::size_t>(grid.across) * static_cast<std::size_t>(grid.deep));
  for (const std::size_t i : solids) {
    const Solid& solid = scene.solids[i];
    sweep_over(solid, i, solid.T_world_solid.inverse() * T_world_hand, sweep, hits);
  }
  return hits;
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/simulate/placement.hpp"

#include <algorithm>
#include <numbers>

namespace graspd {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

std::vector<Footprint> at(const ObjectModel& model, const Place& place) {
  std::vector<Footprint> footprints;
  for (const Footprint& f : model.footprints)
    footprints.push_back(moved(f, place.position, place.yaw_rad, place.z));
  return footprints;
}

bool is_free(const Ground& ground, const std::vector<Footprint>& footprints) {
  for (const Footprint& f : footprints) {
    // The reach is more than it covers: objects stay clear of the table's edge.
    const double margin = ground.walled ? 0 : f.reach();
    if (((f.center.cwiseAbs().array() + margin) > ground.half.array()).any()) return false;
    const auto hits = [&](const Footprint& other) { return collide(f, other, kTouchGap); };
    if (std::any_of(ground.obstacles.begin(), ground.obstacles.end(), hits)) return false;
    for (const Placed& other : ground.placed) {
      if (std::any_of(other.footprints.begin(), other.footprints.end(), hits)) return false;
    }
  }
  return true;
}

Vector2d random_position(const Ground& ground, Rng& rng) {
  if (ground.spread.isZero()) {
    return {rng.uniform(-1, 1) * ground.half.x(), rng.uniform(-1, 1) * ground.half.y()};
  }
  return {rng.normal() * ground.spread.x(), rng.normal() * ground.spread.y()};
}

/// Moves a place straight at an object until they touch; the last place that is free.
std::optional<Place> pushed(const Ground& ground, const ObjectModel& model, Place place,
                            const Placed& target) {
  const Vector2d goal = target.footprints.front().center;
  const Vector2d start = place.position;
  double free = 0;
  double blocked = 1;
  if (!is_free(ground, at(model, place))) return std::nullopt;
  for (double s = 0; s <= 1; s += 0.02) {
    place.position = start + s * (goal - start);
    if (!is_free(ground, at(model, place))) {
      blocked = s;
      break;
    }
    free = s;
  }
  for (int i = 0; i < 8; ++i) {
    const double s = (free + blocked) / 2;
    place.position = start + s * (goal - start);
    (is_free(ground, at(model, place)) ? free : blocked) = s;
  }
  place.position = start + free * (goal - start);
  return place;
}

/// On a flat top that carries all of the object.
std::optional<Place> stacked(const Ground& ground, const ObjectModel& model, Rng& rng) {
  const auto& below = rng.pick(ground.placed);
  if (!below.top) return std::nullopt;
  double reach = 0;
  for (const Footprint& f : model.footprints) reach = std::max(reach, f.center.norm() + f.reach());
  const Vector2d room = below.top->half.array() - reach;
  Place place;
  place.z = below.top->z_min;
  place.yaw_rad = below.top->yaw_rad + rng.uniform(-0.3, 0.3);
  // What does not fit at any angle may fit along the edges, turned with them.
  if ((room.array() < 0).any()) {
    const Footprint& own = model.footprints.front();
    if (model.footprints.size() > 1 || ((own.half.array() + own.radius) > below.top->half.array()).any())
      return std::nullopt;
    place.yaw_rad = below.top->yaw_rad;
    place.position = below.top->center;
  } else {
    const Vector2d offset(rng.uniform(-1, 1) * room.x(), rng.uniform(-1, 1) * room.y());
    place.position = below.top->center + Eigen::Rotation2Dd(below.top->yaw_rad) * offset;
  }
  if (!is_free(ground, at(model, place))) return std::nullopt;
  return place;
}

}  // namespace

std::optional<Place> find_place(const Crowding& crowding, const Ground& ground, const ObjectModel& model,
                                Rng& rng) {
  const double kind = rng.uniform();
  const bool others = !ground.placed.empty();
  constexpr int kAttempts = 200;
  for (int i = 0; i < kAttempts; ++i) {
    if (others && kind < crowding.stacked && i < kAttempts / 2) {
      if (auto place = stacked(ground, model, rng)) return place;
      continue;
    }
    Place place{random_position(ground, rng), rng.uniform(-std::numbers::pi, std::numbers::pi), 0};
    if (!is_free(ground, at(model, place))) continue;
    if (!others || kind >= crowding.stacked + crowding.touching) return place;
    const auto target = static_cast<std::size_t>(rng.index(static_cast<int>(ground.placed.size())));
    if (auto touching = pushed(ground, model, place, ground.placed[target])) return touching;
  }
  return std::nullopt;
}

void put(Scene& scene, Ground& ground, ObjectModel model, const Place& place) {
  Placed placed{at(model, place), std::nullopt};
  if (model.top_half) {
    placed.top = moved({model.top_center, *model.top_half, 0, 0, model.top_z, model.top_z}, place.position,
                       place.yaw_rad, place.z);
  }
  ground.placed.push_back(std::move(placed));
  Eigen::Isometry3d T_world_model = Eigen::Isometry3d::Identity();
  T_world_model.translation() = ground.origin + Vector3d(place.position.x(), place.position.y(), place.z);
  T_world_model.rotate(Eigen::AngleAxisd(place.yaw_rad, Vector3d::UnitZ()));
  model.solid.T_world_solid = T_world_model * model.solid.T_world_solid;
  model.solid.label = object_label(kFirstObject + static_cast<std::uint32_t>(num_objects(scene)));
  scene.solids.push_back(std::move(model.solid));
}

bool put_group(Scene& scene, Ground& ground, const std::vector<ObjectModel>& group, Rng& rng) {
  ObjectModel all;
  for (const ObjectModel& model : group)
    all.footprints.insert(all.footprints.end(), model.footprints.begin(), model.footprints.end());
  constexpr int kAttempts = 300;
  constexpr double kAskew = 0.15;
  for (int i = 0; i < kAttempts; ++i) {
    const double along_walls = rng.index(4) * std::numbers::pi / 2 + rng.uniform(-kAskew, kAskew);
    const double anyhow = rng.uniform(-std::numbers::pi, std::numbers::pi);
    const Place place{random_position(ground, rng), ground.walled ? along_walls : anyhow, 0};
    if (!is_free(ground, at(all, place))) continue;
    for (const ObjectModel& model : group) put(scene, ground, model, place);
    return true;
  }
  return false;
}

int num_objects(const Scene& scene) {
  return static_cast<int>(std::count_if(scene.solids.begin(), scene.solids.end(), [](const Solid& solid) {
    return solid.label >= object_label(kFirstObject);
  }));
}

}  // namespace graspd

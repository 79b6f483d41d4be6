// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/simulate/scene_builder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "client/simulate/footprint.hpp"
#include "client/simulate/object_models.hpp"
#include "client/simulate/rng.hpp"

namespace graspd {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kFloorZ = -0.72;
constexpr double kTouchGap = 0.0005;  // Room for rounding between objects that touch.
constexpr double kBinWallThickness = 0.008;
const Vector2d kTableHalf{0.60, 0.40};
const Vector2d kBinHalf{0.26, 0.18};
constexpr double kBinHeight = 0.14;

/// An object at its place.
struct Placed {
  std::vector<Footprint> footprints;
  std::optional<Footprint> top;  ///< free flat top; its z_min is the height
};

/// Where objects may be, and what is there already.
struct Ground {
  Vector2d half;    ///< of the area that objects must stay in
  Vector2d spread;  ///< deviation of their places from the middle; 0: all over the area
  std::vector<Footprint> obstacles;
  std::vector<Placed> placed;
};

struct Place {
  Vector2d position = Vector2d::Zero();
  double yaw_rad = 0;
  double z = 0;
};

Solid slab(const char* kind, std::uint32_t label, std::uint32_t rgb, const Vector3d& center,
           const Vector3d& half) {
  Solid solid;
  solid.kind = kind;
  solid.label = label;
  solid.rgb = rgb;
  solid.parts.emplace_back(Box{center, half});
  return solid;
}

void add_room(Scene& scene) {
  scene.solids.push_back(slab("floor", kLabelSupport, 0x9c8f7f, {0, 0, kFloorZ - 0.05}, {4, 4, 0.05}));
  scene.solids.push_back(
      slab("table", kLabelSupport, 0xc8a97e, {0, 0, -0.015}, {kTableHalf.x(), kTableHalf.y(), 0.015}));
}

void add_bin(Scene& scene, Ground& ground) {
  const double t = kBinWallThickness / 2;
  for (const double side : {-1.0, 1.0}) {
    const Vector3d along_y(side * (kBinHalf.x() + t), 0, kBinHeight / 2);
    const Vector3d along_x(0, side * (kBinHalf.y() + t), kBinHeight / 2);
    const Vector3d half_y(t, kBinHalf.y() + 2 * t, kBinHeight / 2);
    const Vector3d half_x(kBinHalf.x(), t, kBinHeight / 2);
    for (const auto& [center, half] : {std::pair{along_y, half_y}, std::pair{along_x, half_x}}) {
      scene.solids.push_back(slab("bin_wall", kLabelBinWall, 0x3b6ea5, center, half));
      ground.obstacles.push_back({center.head<2>(), half.head<2>(), 0, 0, 0, kBinHeight});
    }
  }
}

std::vector<Footprint> at(const ObjectModel& model, const Place& place) {
  std::vector<Footprint> footprints;
  for (const Footprint& f : model.footprints)
    footprints.push_back(moved(f, place.position, place.yaw_rad, place.z));
  return footprints;
}

bool is_free(const Ground& ground, const std::vector<Footprint>& footprints) {
  for (const Footprint& f : footprints) {
    // The reach is more than it covers: objects stay clear of the table's edge.
    if (((f.center.cwiseAbs().array() + f.reach()) > ground.half.array()).any()) return false;
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
  const auto& below =
      ground.placed[static_cast<std::size_t>(rng.index(static_cast<int>(ground.placed.size())))];
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

std::optional<Place> find_place(const SceneConfig& config, const Ground& ground, const ObjectModel& model,
                                Rng& rng) {
  const double kind = rng.uniform();
  const bool others = !ground.placed.empty();
  constexpr int kAttempts = 200;
  for (int i = 0; i < kAttempts; ++i) {
    if (others && kind < config.stacked && i < kAttempts / 2) {
      if (auto place = stacked(ground, model, rng)) return place;
      continue;
    }
    Place place{random_position(ground, rng), rng.uniform(-std::numbers::pi, std::numbers::pi), 0};
    if (!is_free(ground, at(model, place))) continue;
    if (!others || kind >= config.stacked + config.touching) return place;
    const auto target = static_cast<std::size_t>(rng.index(static_cast<int>(ground.placed.size())));
    if (auto touching = pushed(ground, model, place, ground.placed[target])) return touching;
  }
  return std::nullopt;
}

void put(Scene& scene, Ground& ground, ObjectModel model, const Place& place) {
  Placed placed{at(model, place), std::nullopt};
  if (model.top_half) {
    placed.top = moved({Vector2d::Zero(), *model.top_half, 0, 0, model.top_z, model.top_z}, place.position,
                       place.yaw_rad, place.z);
  }
  ground.placed.push_back(std::move(placed));
  Eigen::Isometry3d T_world_model = Eigen::Isometry3d::Identity();
  T_world_model.translation() << place.position, place.z;
  T_world_model.rotate(Eigen::AngleAxisd(place.yaw_rad, Vector3d::UnitZ()));
  model.solid.T_world_solid = T_world_model * model.solid.T_world_solid;
  model.solid.label = object_label(kFirstObject + static_cast<std::uint32_t>(num_objects(scene)));
  scene.solids.push_back(std::move(model.solid));
}

}  // namespace

std::optional<SceneKind> scene_kind(std::string_view name) {
  if (name == "table") return SceneKind::kTable;
  if (name == "bin") return SceneKind::kBin;
  if (name == "empty") return SceneKind::kEmpty;
  return std::nullopt;
}

Scene build_scene(const SceneConfig& config, std::uint64_t seed) {
  Rng rng(seed);
  Scene scene;
  add_room(scene);
  if (config.kind == SceneKind::kEmpty) return scene;
  Ground ground{kTableHalf, {0.16, 0.12}, {}, {}};
  if (config.kind == SceneKind::kBin) {
    ground.half = kBinHalf;
    ground.spread.setZero();
    add_bin(scene, ground);
  }
  for (int i = 0; i < config.num_objects; ++i) {
    ObjectModel model = make_random_object(rng);
    if (const auto place = find_place(config, ground, model, rng))
      put(scene, ground, std::move(model), *place);
  }
  return scene;
}

int num_objects(const Scene& scene) {
  return static_cast<int>(std::count_if(scene.solids.begin(), scene.solids.end(), [](const Solid& solid) {
    return solid.label >= object_label(kFirstObject);
  }));
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/simulate/furniture.hpp"

#include <utility>

namespace graspd {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::uint32_t kWood = 0xb08d57, kWall = 0xd8d2c4;

}  // namespace

Solid slab(const char* kind, std::uint32_t label, std::uint32_t rgb, const Vector3d& center,
           const Vector3d& half) {
  Solid solid;
  solid.kind = kind;
  solid.label = label;
  solid.rgb = rgb;
  solid.parts.emplace_back(Box{center, half});
  return solid;
}

void add_loose_objects(ObjectMaker make, int num_objects, Scene& scene, Ground& ground, Rng& rng) {
  for (int i = 0; i < num_objects; ++i) {
    ObjectModel model = make(rng);
    if (const auto place = find_place({}, ground, model, rng)) put(scene, ground, std::move(model), *place);
  }
}

void add_levels(int num_objects, Scene& scene, Ground& ground, Rng& rng) {
  const Vector3d half(rng.uniform(0.15, 0.26), rng.uniform(0.12, 0.2), rng.uniform(0.025, 0.125));
  const double side = rng.index(2) == 0 ? -1 : 1;
  const Vector3d middle(side * rng.uniform(0.18, 0.3), rng.uniform(-0.05, 0.12), half.z());
  scene.solids.push_back(slab("block", kLabelSupport, kWood, middle, half));
  ground.obstacles.push_back({middle.head<2>(), half.head<2>(), 0, 0, 0, 2 * half.z()});
  Ground upper{half.head<2>(), Vector2d::Zero(), {}, {}};
  upper.origin = middle + Vector3d(0, 0, half.z());
  add_loose_objects(make_random_object, num_objects / 2, scene, upper, rng);
  add_loose_objects(make_random_object, num_objects - num_objects / 2, scene, ground, rng);
}

void add_shelf(int num_objects, Scene& scene, Rng& rng) {
  constexpr double kThickness = 0.018, kAbove = 0.32;
  const Vector2d half(0.4, rng.uniform(0.13, 0.18));
  const double room = rng.uniform(0.26, 0.36), height = room + kAbove;
  const double t = kThickness / 2;
  for (const double top : {0.0, room})
    scene.solids.push_back(slab("board", kLabelSupport, kWood, {0, 0, top - t}, {half.x(), half.y(), t}));
  scene.solids.push_back(
      slab("back", kLabelBinWall, kWall, {0, half.y() + t, height / 2}, {half.x() + 2 * t, t, height / 2}));
  for (const double side : {-1.0, 1.0})
    scene.solids.push_back(slab("side", kLabelBinWall, kWall, {side * (half.x() + t), 0, height / 2},
                                {t, half.y(), height / 2}));
  Ground lower{half, Vector2d::Zero(), {{Vector2d::Zero(), half, 0, 0, room - kThickness, room}}, {}};
  Ground upper{half, Vector2d::Zero(), {}, {}};
  upper.origin.z() = room;
  add_loose_objects(make_random_object, num_objects - num_objects / 2, scene, lower, rng);
  add_loose_objects(make_random_object, num_objects / 2, scene, upper, rng);
}

}  // namespace graspd

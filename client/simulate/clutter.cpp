// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/simulate/clutter.hpp"

#include <array>
#include <numbers>

#include "client/simulate/drop.hpp"
#include "client/simulate/object_groups.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;

ObjectModel make_single(Rng& rng) {
  constexpr std::array<ObjectMaker, 20> kMakers{
      make_box, make_box,  make_box,  make_box,          make_small_block, make_can,          make_can,
      make_cup, make_jar,  make_jar,  make_lying_can,    make_lying_can,   make_bottle,       make_bottle,
      make_mug, make_bowl, make_book, make_lying_bottle, make_pen,         make_standing_book};
  return rng.pick(kMakers)(rng);
}

/// Small things that come to lie on others.
ObjectModel make_droppable(Rng& rng) {
  constexpr std::array<ObjectMaker, 6> kMakers{make_box,       make_pen, make_small_block,
                                               make_lying_can, make_jar, make_lying_bottle};
  return rng.pick(kMakers)(rng);
}

std::vector<ObjectModel> make_group(Rng& rng) {
  constexpr std::array<std::vector<ObjectModel> (*)(Rng&), 4> kMakers{make_book_row, make_book_row,
                                                                      make_box_row, make_book_pile};
  return rng.pick(kMakers)(rng);
}

/// A tilt about a level axis and a turn about the vertical one, somewhere above everything.
Eigen::Isometry3d tossed(const Ground& ground, Rng& rng) {
  constexpr double kAbove = 0.40;
  constexpr double kMaxTilt = 0.4;
  constexpr double kInward = 0.75;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = Vector3d(kInward * rng.uniform(-1, 1) * ground.half.x(),
                             kInward * rng.uniform(-1, 1) * ground.half.y(), kAbove);
  if (!ground.spread.isZero()) {
    T.translation().head<2>() << rng.normal() * ground.spread.x(), rng.normal() * ground.spread.y();
  }
  T.rotate(Eigen::AngleAxisd(rng.uniform(-std::numbers::pi, std::numbers::pi), Vector3d::UnitZ()));
  T.rotate(Eigen::AngleAxisd(rng.uniform(-kMaxTilt, kMaxTilt), Vector3d::UnitY()));
  return T;
}

/// The lowest of several falls, as what falls slides on until it lies low.
bool drop(Scene& scene, Ground& ground, const ObjectModel& model, Rng& rng) {
  constexpr int kFalls = 8;
  constexpr double kDrop = 0.5;
  std::optional<Eigen::Isometry3d> best;
  for (int i = 0; i < kFalls; ++i) {
    Solid solid = model.solid;
    solid.T_world_solid = tossed(ground, rng) * solid.T_world_solid;
    const auto T = lowered(scene, solid, kDrop);
    if (T && (!best || T->translation().z() < best->translation().z())) best = T;
  }
  if (!best) return false;
  ObjectModel fallen;
  fallen.solid = model.solid;
  fallen.solid.T_world_solid = *best;
  put(scene, ground, std::move(fallen), {});
  return true;
}

}  // namespace

ClutterConfig easy_clutter() {
  return {0, 0, {0, 0}};
}
ClutterConfig medium_clutter() {
  return {0, 0.1, {0.5, 0.1}};
}
ClutterConfig hard_clutter() {
  return {1, 0.15, {0.8, 0.2}};
}
ClutterConfig extreme_clutter() {
  return {3, 0.25, {0.9, 0.25}};
}

void add_clutter(const ClutterConfig& config, int wanted, Scene& scene, Ground& ground, Rng& rng) {
  for (int i = 0; i < config.num_groups && num_objects(scene) < wanted; ++i) {
    const auto group = make_group(rng);
    if (num_objects(scene) + static_cast<int>(group.size()) <= wanted) put_group(scene, ground, group, rng);
  }
  const int singles = wanted - num_objects(scene);
  const int dropped = static_cast<int>(config.dropped * singles);
  for (int i = dropped; i < singles; ++i) {
    ObjectModel model = make_single(rng);
    if (const auto place = find_place(config.crowding, ground, model, rng))
      put(scene, ground, std::move(model), *place);
  }
  for (int i = 0; i < dropped; ++i) drop(scene, ground, make_droppable(rng), rng);
}

}  // namespace graspd

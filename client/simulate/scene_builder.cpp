// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/simulate/scene_builder.hpp"

#include <array>
#include <utility>

#include "client/simulate/clutter.hpp"
#include "client/simulate/household_models.hpp"
#include "client/simulate/placement.hpp"

namespace graspd {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kFloorZ = -0.72;
constexpr double kBinWallThickness = 0.008;
const Vector2d kTableHalf{0.60, 0.40};
const Vector2d kBinHalf{0.26, 0.18};
constexpr double kBinHeight = 0.14;

struct KindOfScene {
  std::string_view name;
  SceneKind kind;
  bool in_bin;
  int num_objects;  // where the configuration does not say
};
constexpr std::array<KindOfScene, 8> kKinds{{{"table", SceneKind::kTable, false, 8},
                                             {"bin", SceneKind::kBin, true, 8},
                                             {"empty", SceneKind::kEmpty, false, 0},
                                             {"easy", SceneKind::kEasy, false, 4},
                                             {"medium", SceneKind::kMedium, false, 8},
                                             {"hard", SceneKind::kHard, false, 14},
                                             {"extreme", SceneKind::kExtreme, true, 24},
                                             {"household", SceneKind::kHousehold, false, 6}}};

const KindOfScene& properties(SceneKind kind) {
  return kKinds[static_cast<std::size_t>(kind)];
}

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

/// Nothing leans, and nothing lies on something else.
void add_loose_objects(ObjectMaker make, int num_objects, Scene& scene, Ground& ground, Rng& rng) {
  for (int i = 0; i < num_objects; ++i) {
    ObjectModel model = make(rng);
    if (const auto place = find_place({}, ground, model, rng)) put(scene, ground, std::move(model), *place);
  }
}

}  // namespace

std::optional<SceneKind> scene_kind(std::string_view name) {
  for (const KindOfScene& one : kKinds)
    if (one.name == name) return one.kind;
  return std::nullopt;
}

std::vector<std::string> scene_kind_names() {
  std::vector<std::string> names;
  for (const KindOfScene& one : kKinds) names.emplace_back(one.name);
  return names;
}

bool in_bin(SceneKind kind) {
  return properties(kind).in_bin;
}

Scene build_scene(const SceneConfig& config, std::uint64_t seed) {
  Rng rng(seed);
  Scene scene;
  add_room(scene);
  if (config.kind == SceneKind::kEmpty) return scene;
  Ground ground{kTableHalf, {0.16, 0.12}, {}, {}};
  if (in_bin(config.kind)) {
    ground.half = kBinHalf;
    ground.spread.setZero();
    add_bin(scene, ground);
  }
  const int num = config.num_objects.value_or(properties(config.kind).num_objects);
  switch (config.kind) {
    case SceneKind::kEasy:
      add_clutter(easy_clutter(), num, scene, ground, rng);
      break;
    case SceneKind::kMedium:
      add_clutter(medium_clutter(), num, scene, ground, rng);
      break;
    case SceneKind::kHard:
      add_clutter(hard_clutter(), num, scene, ground, rng);
      break;
    case SceneKind::kExtreme:
      ground.walled = true;
      add_clutter(extreme_clutter(), num, scene, ground, rng);
      break;
    case SceneKind::kHousehold:
      add_loose_objects(make_household_object, num, scene, ground, rng);
      break;
    default:
      add_loose_objects(make_random_object, num, scene, ground, rng);
  }
  return scene;
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/simulate/scene_builder.hpp"

#include <array>
#include <utility>

#include "client/simulate/clutter.hpp"
#include "client/simulate/furniture.hpp"
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
  int num_objects;                 // where the configuration does not say
  double elevation_deg, target_m;  // of the usual view
};
constexpr std::array<KindOfScene, 10> kKinds{{{"table", SceneKind::kTable, false, 8, 43, 0.03},
                                              {"bin", SceneKind::kBin, true, 8, 63, 0.03},
                                              {"empty", SceneKind::kEmpty, false, 0, 43, 0.03},
                                              {"easy", SceneKind::kEasy, false, 4, 43, 0.03},
                                              {"medium", SceneKind::kMedium, false, 8, 43, 0.03},
                                              {"hard", SceneKind::kHard, false, 14, 43, 0.03},
                                              {"extreme", SceneKind::kExtreme, true, 24, 63, 0.03},
                                              {"household", SceneKind::kHousehold, false, 6, 43, 0.03},
                                              {"levels", SceneKind::kLevels, false, 8, 43, 0.03},
                                              {"shelf", SceneKind::kShelf, false, 8, 30, 0.17}}};

const KindOfScene& properties(SceneKind kind) {
  return kKinds[static_cast<std::size_t>(kind)];
}

void add_floor(Scene& scene) {
  scene.solids.push_back(slab("floor", kLabelSupport, 0x9c8f7f, {0, 0, kFloorZ - 0.05}, {4, 4, 0.05}));
}

void add_table(Scene& scene) {
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

double usual_elevation_deg(SceneKind kind) {
  return properties(kind).elevation_deg;
}

double usual_target_m(SceneKind kind) {
  return properties(kind).target_m;
}

Scene build_scene(const SceneConfig& config, std::uint64_t seed) {
  Rng rng(seed);
  Scene scene;
  add_floor(scene);
  const int num = config.num_objects.value_or(properties(config.kind).num_objects);
  if (config.kind == SceneKind::kShelf) {
    add_shelf(num, scene, rng);
    return scene;
  }
  add_table(scene);
  if (config.kind == SceneKind::kEmpty) return scene;
  Ground ground{kTableHalf, {0.16, 0.12}, {}, {}};
  if (in_bin(config.kind)) {
    ground.half = kBinHalf;
    ground.spread.setZero();
    add_bin(scene, ground);
  }
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
    case SceneKind::kLevels:
      add_levels(num, scene, ground, rng);
      break;
    default:
      add_loose_objects(make_random_object, num, scene, ground, rng);
  }
  return scene;
}

}  // namespace graspd

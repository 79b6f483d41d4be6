// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/simulate/furniture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "client/simulate/scene_builder.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;

/// The kind of what an object stands on: the first solid met straight below its middle.
std::string carrier(const Scene& scene, const Solid& object) {
  Scene others;
  for (const Solid& solid : scene.solids)
    if (solid.label != object.label) others.solids.push_back(solid);
  const auto hit = cast(others, {object.T_world_solid.translation() + Vector3d(0, 0, 0.001), {0, 0, -1}});
  return hit ? others.solids[hit->solid].kind : "nothing";
}

/// Objects on each kind of thing, over some seeds.
std::map<std::string, int> count_carriers(SceneKind kind) {
  std::map<std::string, int> num;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Scene scene = build_scene({kind, {}}, seed);
    for (const Solid& solid : scene.solids)
      if (solid.label >= object_label(kFirstObject)) ++num[carrier(scene, solid)];
  }
  return num;
}

TEST(Furniture, ThingsStandOnTheBlockAndOnTheTable) {
  const std::map<std::string, int> num = count_carriers(SceneKind::kLevels);
  EXPECT_GE(num.at("block"), 40);
  EXPECT_GE(num.at("table"), 60);
  EXPECT_FALSE(num.contains("floor"));
  EXPECT_FALSE(num.contains("nothing"));
}

TEST(Furniture, ThingsStandOnBothBoardsOfAShelf) {
  const std::map<std::string, int> num = count_carriers(SceneKind::kShelf);
  EXPECT_GE(num.at("board"), 100);
  EXPECT_FALSE(num.contains("floor"));
  EXPECT_FALSE(num.contains("nothing"));
  int low = 0, high = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    for (const Solid& solid : build_scene({SceneKind::kShelf, {}}, seed).solids)
      if (solid.label >= object_label(kFirstObject))
        ++(solid.T_world_solid.translation().z() > 0.25 ? high : low);
  EXPECT_GE(low, 40);
  EXPECT_GE(high, 40);
}

TEST(Furniture, AreLevelAtTheHeightsTheyAreSaidToBe) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Scene scene = build_scene({SceneKind::kLevels, 0}, seed);
    const auto block = std::find_if(scene.solids.begin(), scene.solids.end(),
                                    [](const Solid& solid) { return solid.kind == "block"; });
    ASSERT_NE(block, scene.solids.end());
    EXPECT_EQ(block->label, kLabelSupport);
    const auto& box = std::get<Box>(block->parts[0]);
    EXPECT_NEAR(box.center.z(), box.half.z(), 1e-12) << "stands on the table";
    EXPECT_GE(2 * box.half.z(), 0.05);
    EXPECT_LE(2 * box.half.z(), 0.25);
    EXPECT_GE(2 * box.half.y(), 0.2) << "too wide to be held";
  }
}

}  // namespace
}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/simulate/clutter.hpp"

#include <gtest/gtest.h>

#include <map>

#include "client/simulate/drop.hpp"
#include "client/simulate/object_groups.hpp"
#include "client/simulate/scene_builder.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;

constexpr std::array kLevels{SceneKind::kEasy, SceneKind::kMedium, SceneKind::kHard, SceneKind::kExtreme};
constexpr std::array kScenes{SceneKind::kEasy,      SceneKind::kMedium, SceneKind::kHard, SceneKind::kExtreme,
                             SceneKind::kHousehold, SceneKind::kLevels, SceneKind::kShelf};

bool touches(const Scene& scene, std::size_t object, const Vector3d& move) {
  Solid moved = scene.solids[object];
  moved.T_world_solid.pretranslate(move);
  for (std::size_t i = 0; i < scene.solids.size(); ++i)
    if (i != object && overlap(moved, scene.solids[i])) return true;
  return false;
}

TEST(Clutter, NothingGoesThroughAnythingElse) {
  for (const SceneKind kind : kScenes) {
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
      const Scene scene = build_scene({kind, {}}, seed);
      for (std::size_t i = 0; i < scene.solids.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          EXPECT_FALSE(overlap(scene.solids[i], scene.solids[j]))
              << "seed " << seed << ": " << scene.solids[i].kind << " in " << scene.solids[j].kind;
    }
  }
}

TEST(Clutter, EveryObjectRestsOnSomething) {
  for (const SceneKind kind : kScenes) {
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
      const Scene scene = build_scene({kind, {}}, seed);
      for (std::size_t i = 0; i < scene.solids.size(); ++i) {
        if (scene.solids[i].label < object_label(kFirstObject)) continue;
        EXPECT_TRUE(touches(scene, i, {0, 0, -0.0015})) << "seed " << seed << ": " << scene.solids[i].kind;
      }
    }
  }
}

TEST(Clutter, GrowsWithTheLevel) {
  std::map<SceneKind, int> objects, touching;
  for (const SceneKind kind : kLevels) {
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
      const Scene scene = build_scene({kind, {}}, seed);
      objects[kind] += num_objects(scene);
      for (std::size_t i = 0; i < scene.solids.size(); ++i) {
        if (scene.solids[i].label < object_label(kFirstObject)) continue;
        bool beside = false;
        for (const Vector3d& move :
             {Vector3d(1, 0, 0), Vector3d(-1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, -1, 0)})
          beside |= touches(scene, i, 0.003 * move + Vector3d(0, 0, 0.001));
        touching[kind] += beside ? 1 : 0;
      }
    }
  }
  EXPECT_EQ(objects[SceneKind::kEasy], 8 * 4);
  EXPECT_EQ(touching[SceneKind::kEasy], 0);
  EXPECT_GT(touching[SceneKind::kMedium], 8);
  for (std::size_t i = 1; i < kLevels.size(); ++i) {
    EXPECT_GT(objects[kLevels[i]], objects[kLevels[i - 1]]);
    EXPECT_GT(touching[kLevels[i]], touching[kLevels[i - 1]]);
  }
}

/// How many there are of each kind in the scenes of the first seeds.
std::map<std::string, int> count_kinds(SceneKind scene, std::uint64_t num_seeds) {
  std::map<std::string, int> kinds;
  for (std::uint64_t seed = 0; seed < num_seeds; ++seed)
    for (const Solid& solid : build_scene({scene, {}}, seed).solids) ++kinds[solid.kind];
  return kinds;
}

TEST(Clutter, TheExtremeBinHasThePapersThings) {
  std::map<std::string, int> kinds = count_kinds(SceneKind::kExtreme, 30);
  for (const char* kind : {"standing_book", "leaning_book", "book", "box", "bottle", "lying_bottle", "can",
                           "lying_can", "cup", "mug", "bowl", "jar", "pen", "small_block"})
    EXPECT_GT(kinds[kind], 0) << kind;
  EXPECT_GT(kinds["standing_book"], 60);
}

TEST(Clutter, AHouseholdHasThingsOfAllItsKinds) {
  std::map<std::string, int> kinds = count_kinds(SceneKind::kHousehold, 20);
  for (const char* kind : {"screwdriver", "hammer", "banana", "goblet", "pan", "bracket", "ring", "dumbbell"})
    EXPECT_GT(kinds[kind], 0) << kind;
}

TEST(ObjectGroups, BooksOfARowTouchAndTheLastOneLeans) {
  int leaning = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Rng rng(seed);
    Scene row;
    for (const ObjectModel& book : make_book_row(rng)) row.solids.push_back(book.solid);
    ASSERT_GE(row.solids.size(), 3u);
    for (std::size_t i = 1; i < row.solids.size(); ++i) {
      EXPECT_FALSE(overlap(row.solids[i], row.solids[i - 1]));
      Solid pushed = row.solids[i];
      pushed.T_world_solid.pretranslate(Vector3d(-0.0015, 0, 0));
      EXPECT_TRUE(overlap(pushed, row.solids[i - 1])) << row.solids[i].kind;
    }
    leaning += row.solids.back().kind == "leaning_book" ? 1 : 0;
  }
  EXPECT_GT(leaning, 10);
  EXPECT_LT(leaning, 40);
}

TEST(Drop, StopsAtFirstContact) {
  Scene scene{{Solid{}}};
  scene.solids[0].parts.emplace_back(Box{{0, 0, -0.05}, {0.5, 0.5, 0.05}});
  Solid ball;
  ball.parts.emplace_back(Ball{Vector3d::Zero(), 0.03});
  ball.T_world_solid.translation().z() = 0.2;
  const auto T = lowered(scene, ball, 0.5);
  ASSERT_TRUE(T);
  EXPECT_NEAR(T->translation().z(), 0.03, 0.001);
  EXPECT_GE(T->translation().z(), 0.03);
  const auto held_back = lowered(scene, ball, 0.1);
  ASSERT_TRUE(held_back);
  EXPECT_NEAR(held_back->translation().z(), 0.1, 0.001);
  ball.T_world_solid.translation().z() = 0.02;
  EXPECT_FALSE(lowered(scene, ball, 0.5)) << "starts inside";
}

TEST(Drop, OverlapIsSymmetricAndKnowsHollows) {
  Solid cup;
  cup.parts.emplace_back(Cylinder{0.04, 0, 0.1});
  cup.cavity = Cylinder{0.036, 0.004, 0.2};
  Solid ball;
  ball.parts.emplace_back(Ball{Vector3d::Zero(), 0.03});
  ball.T_world_solid.translation().z() = 0.05;
  EXPECT_FALSE(overlap(cup, ball));
  EXPECT_FALSE(overlap(ball, cup));
  ball.T_world_solid.translation().x() = 0.008;
  EXPECT_TRUE(overlap(cup, ball));
  EXPECT_TRUE(overlap(ball, cup));
}

}  // namespace
}  // namespace graspd

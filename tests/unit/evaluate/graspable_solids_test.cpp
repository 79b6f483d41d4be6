// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/graspable_solids.hpp"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include "client/simulate/scene_builder.hpp"
#include "tests/unit/evaluate/solid_scenes.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;

const Pinhole kCamera{320, 240, 262.5, 262.5, 159.5, 119.5};

struct View {
  Scene scene;
  Eigen::Isometry3d T_world_camera = look_at({0, -0.5, 0.6}, {0, 0, 0.03});
};

std::vector<GraspableSolid> search(const View& view, const Gripper& gripper = {},
                                   const GraspSearchConfig& config = {}) {
  const SolidJudge judge(view.scene, gripper);
  return graspable_solids(judge, render(view.scene, kCamera, view.T_world_camera), view.T_world_camera,
                          config);
}

TEST(GraspableSolids, FindsWhatFitsBetweenTheJaws) {
  View view{bare_table()};
  add_body(view.scene, Box{{0, 0, 0.04}, {0.02, 0.03, 0.04}}, {-0.15, 0, 0});
  add_body(view.scene, Box{{0, 0, 0.05}, {0.05, 0.05, 0.05}}, {0.15, 0, 0});
  const auto narrow_jaws = search(view);
  ASSERT_EQ(narrow_jaws.size(), 2u);
  EXPECT_EQ(narrow_jaws[0].label, 20u);
  EXPECT_TRUE(narrow_jaws[0].graspable);
  EXPECT_FALSE(narrow_jaws[1].graspable) << "100 mm each way";
  EXPECT_TRUE(narrow_jaws[1].poses.empty());
  Gripper wide;
  wide.aperture_m = 0.12f;
  EXPECT_TRUE(search(view, wide)[1].graspable);
}

TEST(GraspableSolids, TouchingNeighboursLeaveNoRoom) {
  View view{bare_table()};
  for (const double x : {-0.0805, 0.0, 0.0805}) {
    for (const double y : {-0.0905, 0.0, 0.0905})
      add_body(view.scene, Box{{0, 0, 0.05}, {0.04, 0.045, 0.05}}, {x, y, 0});
  }
  view.T_world_camera = look_at({0, -0.2, 0.8}, {0, 0, 0.03});
  Gripper wide;
  wide.aperture_m = 0.085f;
  const auto found = search(view, wide);
  ASSERT_EQ(found.size(), 9u);
  EXPECT_FALSE(found[4].graspable) << "in the middle of a tight block";
}

TEST(GraspableSolids, WhatIsHardlySeenDoesNotCount) {
  View view{bare_table()};
  add_body(view.scene, Box{{0, 0, 0.1}, {0.15, 0.01, 0.1}}, Vector3d::Zero());
  add_body(view.scene, Ball{{0, 0, 0.02}, 0.02}, {0, 0.05, 0});
  view.T_world_camera = look_at({0, -0.8, 0.1}, {0, 0, 0.03});
  const auto found = search(view);
  ASSERT_EQ(found.size(), 1u) << "the ball is behind the wall";
  EXPECT_EQ(found[0].label, 20u);
}

TEST(GraspableSolids, EveryPoseHoldsAndKeepsHolding) {
  View view{build_scene({SceneKind::kExtreme, {}}, 12)};
  const GraspSearchConfig config;
  const SolidJudge judge(view.scene, Gripper{});
  int graspable = 0;
  for (const GraspableSolid& object : search(view)) {
    graspable += object.graspable ? 1 : 0;
    EXPECT_EQ(object.graspable, object.poses.size() == static_cast<std::size_t>(config.min_poses));
    EXPECT_GE(object.pixels, config.min_pixels);
    for (const Handle& pose : object.poses) {
      const SolidVerdict verdict = judge.judge(pose);
      EXPECT_TRUE(verdict.holds()) << verdict.text(view.scene);
      EXPECT_EQ(verdict.solid, object.solid);
      EXPECT_GE(undisturbed(judge, pose, object.solid), config.min_undisturbed);
    }
  }
  EXPECT_GT(graspable, 3);
}

TEST(GraspableSolids, TheResultDoesNotDependOnThreads) {
  const View view{build_scene({SceneKind::kHard, {}}, 4)};
  const auto with_threads = [&](int threads) {
    tbb::task_arena arena(threads);
    return arena.execute([&] { return search(view); });
  };
  const auto one = with_threads(1), two = with_threads(2);
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].solid, two[i].solid);
    ASSERT_EQ(one[i].poses.size(), two[i].poses.size());
    for (std::size_t k = 0; k < one[i].poses.size(); ++k)
      EXPECT_EQ(one[i].poses[k].position, two[i].poses[k].position);
  }
}

TEST(Undisturbed, CountsWhatATightPoseSurvives) {
  Scene scene = bare_table();
  add_body(scene, Box{{0, 0, 0.05}, {0.0395, 0.03, 0.05}}, Vector3d::Zero());
  const SolidJudge judge(scene, Gripper{});
  const Handle tight = handle_from_above(0, 0, 0.07, 0.079);
  ASSERT_TRUE(judge.judge(tight).holds());
  EXPECT_EQ(undisturbed(judge, tight, 1), 8)
      << "not moved along the closing axis, not tilted about the major";
  add_body(scene, Box{{0, 0, 0.05}, {0.02, 0.03, 0.05}}, {0.3, 0, 0});
  const SolidJudge again(scene, Gripper{});
  EXPECT_EQ(undisturbed(again, handle_from_above(0.3, 0, 0.06, 0.04), 2), 12);
}

}  // namespace
}  // namespace graspd

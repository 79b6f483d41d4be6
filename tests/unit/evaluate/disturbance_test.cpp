// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/disturbance.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/unit/evaluate/labelled_scene.hpp"

namespace graspd {
namespace {

TEST(Disturbance, EachIsOneMoveOrOneTurnAndNoTwoAreTheSame) {
  const Handle handle = on_box();
  const auto all = disturbed(handle);
  int moves = 0, turns = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const float moved = (all[i].position - handle.position).norm();
    const float turned =
        Eigen::AngleAxisf(Eigen::Matrix3f(handle.rotation.transpose() * all[i].rotation)).angle();
    if (moved > 0) {
      EXPECT_NEAR(moved, 0.003f, 1e-6f);
      EXPECT_NEAR(turned, 0, 1e-3f);
      ++moves;
    } else {
      EXPECT_NEAR(turned, 5 * std::numbers::pi_v<float> / 180, 1e-3f);
      ++turns;
    }
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GT((all[i].position - all[j].position).norm() + (all[i].rotation - all[j].rotation).norm(),
                1e-3f);
  }
  EXPECT_EQ(moves, 6);
  EXPECT_EQ(turns, 6);
}

TEST(Disturbance, AGoodHandleIsSteadyAndABadOneIsNot) {
  const LabelScene scene(labelled(box_on_table()));
  EXPECT_GE(valid_disturbances(scene, {}, on_box()), 10);
  EXPECT_EQ(valid_disturbances(scene, {}, from_above({0.3f, 0, 0.2f}, 0.05f)), 0);
}

TEST(Disturbance, CountingStopsAtWhatIsWanted) {
  const LabelScene scene(labelled(box_on_table()));
  EXPECT_EQ(valid_disturbances(scene, {}, on_box(), 3), 3);
}

}  // namespace
}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/gripper.hpp"

#include <gtest/gtest.h>

namespace graspd {
namespace {

void expect_problem(const Gripper& gripper, const std::string& key) {
  const auto problem = gripper.validate();
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->key, key);
  EXPECT_FALSE(problem->reason.empty());
}

TEST(Gripper, ThePapersGripperIsPossible) {
  EXPECT_FALSE(Gripper{}.validate());
}

TEST(Gripper, AFingerMustFitIntoTheGap) {
  Gripper gripper;
  gripper.min_gap_m = gripper.finger_width_m;
  expect_problem(gripper, "min_gap_m");
  gripper.min_gap_m = 0.5f * gripper.finger_width_m;
  expect_problem(gripper, "min_gap_m");
}

TEST(Gripper, ThePalmMustNotHitTheObject) {
  Gripper gripper;
  gripper.grasp_depth_m = gripper.finger_length_m;
  expect_problem(gripper, "grasp_depth_m");
  gripper.grasp_depth_m = 2 * gripper.finger_length_m;
  expect_problem(gripper, "grasp_depth_m");
}

}  // namespace
}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/patch_fit.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/scene_gallery.hpp"
#include "tests/unit/pipeline/check_scene.hpp"

namespace graspd {
namespace {

const Eigen::Vector3f kDown = -Eigen::Vector3f::UnitZ();
const Eigen::Vector3f kAcross = Eigen::Vector3f::UnitX();  // the line of sight

struct Fitted {
  Failure failure = Failure::kNone;
  PatchFit fit;
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< of the handle
};

Fitted fit_at(const CheckScene& scene, const Candidate& candidate, const Gripper& gripper = {}) {
  Fitted fitted;
  CheckBuffers buffers;
  fitted.failure = fit_patch(scene.view(), gripper, {}, candidate, buffers, fitted.fit);
  fitted.position =
      candidate.position + candidate.rotation * Eigen::Vector3f(0, fitted.fit.center_m, fitted.fit.top_m);
  return fitted;
}

Fitted fit_from_above(const CheckScene& scene, const Eigen::Vector3f& seed, const Gripper& gripper = {}) {
  return fit_at(scene, scene.candidate(seed, kDown, kAcross), gripper);
}

TEST(PatchFit, NothingThere) {
  const CheckScene scene(box_on_table());
  EXPECT_EQ(fit_from_above(scene, {0, 0, 0.5f}).failure, Failure::kTooFewPoints);
  Candidate of_another = scene.candidate({0, 0, 0.08f}, kDown, kAcross);
  of_another.object = 1000;
  EXPECT_EQ(fit_at(scene, of_another).failure, Failure::kTooFewPoints);
}

TEST(PatchFit, TheMiddleOfTheTopFromWhereverOnIt) {
  const CheckScene scene(box_on_table());
  for (const float x : {-0.02f, -0.01f, 0.0f, 0.015f, 0.022f}) {
    SCOPED_TRACE(x);
    const Fitted fitted = fit_from_above(scene, {x, 0, 0.08f});
    ASSERT_EQ(fitted.failure, Failure::kNone);
    EXPECT_NEAR(fitted.position.x(), 0, 0.002f);
    EXPECT_NEAR(fitted.position.z(), 0.08f, 0.002f);
    EXPECT_NEAR(fitted.fit.width_m, 0.05f, 0.003f);
  }
}

TEST(PatchFit, ASeedDeepOnTheFrontEndsAtTheTop) {
  const CheckScene scene(box_on_table());
  for (const float z : {0.07f, 0.055f, 0.04f, 0.025f, 0.01f})
    for (const float x : {-0.018f, 0.0f, 0.018f}) {
      SCOPED_TRACE(z);
      SCOPED_TRACE(x);
      const Fitted fitted = fit_from_above(scene, {x, -0.06f, z});
      ASSERT_EQ(fitted.failure, Failure::kNone);
      EXPECT_NEAR(fitted.position.z(), 0.08f, 0.002f);
      EXPECT_NEAR(fitted.position.x(), 0, 0.002f);
      EXPECT_NEAR(fitted.fit.width_m, 0.05f, 0.003f);
    }
}

TEST(PatchFit, GapsAreWhatIsFreeBesideIt) {
  const Gripper gripper;
  const auto [left, right] = fit_from_above(CheckScene(box_on_table()), {0, 0, 0.08f}).fit.gap_m;
  EXPECT_FLOAT_EQ(left, gripper.aperture_m) << "free for more than the aperture counts as that";
  EXPECT_FLOAT_EQ(right, gripper.aperture_m);
  const CheckScene two(
      on_table({standing_box(-0.04, 0, {0.05, 0.12, 0.08}), standing_box(0.04, 0, {0.05, 0.12, 0.08})}));
  const Fitted fitted = fit_from_above(two, {-0.04f, 0, 0.08f});
  ASSERT_EQ(fitted.failure, Failure::kNone);
  // The jaws close along x: which of the two gaps is towards the other box is the gripper's -y and +y.
  EXPECT_NEAR(fitted.fit.gap_m[1], 0.03f, 0.003f);
  EXPECT_FLOAT_EQ(fitted.fit.gap_m[0], gripper.aperture_m);
}

TEST(PatchFit, WiderThanTheApertureIsTooWide) {
  EXPECT_EQ(fit_from_above(CheckScene(too_wide_box()), {0, 0, 0.1f}).failure, Failure::kTooWide);
  Gripper wide;
  wide.aperture_m = 0.14f;
  EXPECT_EQ(fit_from_above(CheckScene(too_wide_box()), {0, 0, 0.1f}, wide).failure, Failure::kNone);
}

TEST(PatchFit, OnAFlatThingTheSupportLeavesNoDepth) {
  const CheckScene scene(on_table({standing_box(0, 0, {0.05, 0.12, 0.007})}));
  EXPECT_EQ(fit_from_above(scene, {0, 0, 0.007f}).failure, Failure::kFingers);
}

TEST(PatchFit, ALowThingIsTakenByMostOfItsHeight) {
  const HandleCheckConfig config;
  for (const float height : {0.011f, 0.014f, 0.018f}) {
    SCOPED_TRACE(height);
    const CheckScene scene(on_table({standing_box(0, 0, {0.05, 0.12, height})}));
    const Fitted fitted = fit_from_above(scene, {0, 0, height});
    ASSERT_EQ(fitted.failure, Failure::kNone);
    const float tip_z = fitted.position.z() - Gripper{}.grasp_depth_m;
    EXPECT_GT(tip_z, 0);
    EXPECT_LT(tip_z, height - std::min(config.min_grip_depth_m, config.min_grip_share * height) + 0.0005f);
    EXPECT_LT(tip_z, 0.005f) << "no higher than it must";
  }
}

TEST(PatchFit, FromTheSideALowThingOffersNoLessThanAnyOther) {
  const CheckScene scene(on_table({standing_box(0, 0, {0.05, 0.12, 0.014})}));
  const HandleCheckConfig config;
  const Eigen::Vector3f top(0, 0, 0.014f), level = Eigen::Vector3f::UnitY();
  EXPECT_FLOAT_EQ(least_grip_depth(scene.view().plane_under(0), config, top, level), config.min_grip_depth_m);
  EXPECT_NEAR(least_grip_depth(scene.view().plane_under(0), config, top, kDown),
              config.min_grip_share * 0.014f, 3e-4f);
  EXPECT_FLOAT_EQ(least_grip_depth(scene.view().plane_under(0), config, {0, 0, 0.05f}, kDown),
                  config.min_grip_depth_m);
}

TEST(PatchFit, FingersGoLessDeepWhereTheSupportIsNear) {
  // 25 mm high and fingertips 30 mm below the top: the handle is that much higher.
  const CheckScene scene(on_table({standing_box(0, 0, {0.05, 0.12, 0.025})}));
  const Gripper gripper;
  const Fitted fitted = fit_from_above(scene, {0, 0, 0.025f});
  ASSERT_EQ(fitted.failure, Failure::kNone);
  const float tip_z = fitted.position.z() - gripper.grasp_depth_m;
  EXPECT_GT(tip_z, 0);
  EXPECT_LT(tip_z, 0.006f) << "no higher than it must";
}

/// Three boxes side by side without a gap, the one in the middle 100 mm high.
AnalyticScene row_of_boxes(double height_beside) {
  return on_table({standing_box(-0.045, 0, {0.05, 0.10, height_beside}),
                   standing_box(0, 0, {0.04, 0.14, 0.10}),
                   standing_box(0.045, 0, {0.05, 0.10, height_beside})});
}

TEST(PatchFit, FingersGoNoDeeperThanWhatTouchesTheObject) {
  const Gripper gripper;
  for (const float beside : {0.085f, 0.08f, 0.075f}) {
    SCOPED_TRACE(beside);
    const CheckScene scene(row_of_boxes(beside));
    const Fitted fitted = fit_from_above(scene, {0.005f, 0, 0.10f});
    ASSERT_EQ(fitted.failure, Failure::kNone);
    EXPECT_NEAR(fitted.fit.width_m, 0.04f, 0.003f);
    EXPECT_NEAR(fitted.position.x(), 0, 0.002f);
    const float tip_z = fitted.position.z() - gripper.grasp_depth_m;
    EXPECT_GT(tip_z, beside);
    EXPECT_LT(tip_z, beside + 0.006f) << "no higher than it must";
  }
}

TEST(PatchFit, WhatHardlyStandsOutOfARowHasNoGap) {
  EXPECT_EQ(fit_from_above(CheckScene(row_of_boxes(0.09)), {0, 0, 0.10f}).failure, Failure::kNoGap);
  EXPECT_EQ(fit_from_above(CheckScene(wedged_boxes()), {0, 0, 0.08f}).failure, Failure::kTooWide)
      << "of one height they look like one";
}

}  // namespace
}  // namespace graspd

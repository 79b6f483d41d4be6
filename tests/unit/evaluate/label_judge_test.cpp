// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/label_judge.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "tests/support/clouds.hpp"
#include "tests/unit/evaluate/labelled_scene.hpp"

namespace graspd {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

Verdict verdict(const AnalyticScene& scene, const Handle& handle, const Gripper& gripper = {}) {
  return judge(LabelScene(labelled(scene)), gripper, handle);
}

std::string failure(const AnalyticScene& scene, const Handle& handle, const Gripper& gripper = {}) {
  return std::string(name(verdict(scene, handle, gripper).failure));
}

AnalyticSolid floating_box(const Eigen::Vector3d& center, double edge) {
  AnalyticSolid box = standing_box(center.x(), center.y(), {edge, edge, edge});
  box.T_scene_solid.translation().z() = center.z();
  return box;
}

AnalyticScene with(AnalyticScene scene, const AnalyticSolid& solid) {
  scene.solids.push_back(solid);
  return scene;
}

/// A hole in the measured support around what stands in the middle.
LabelScene without_support_nearby(const AnalyticScene& scene) {
  LabelledCloud cloud = labelled(scene);
  for (std::size_t i = 0; i < cloud.cloud.size(); ++i)
    if (cloud.label[i] == 1 && cloud.cloud.point(i).norm() < 0.12f) cloud.cloud.z[i] = NAN;
  return LabelScene(cloud);
}

/// A box with one long edge up: between the jaws it is a wedge.
AnalyticScene ridge() {
  AnalyticSolid box = standing_box(0, 0, {0.06, 0.12, 0.06});
  box.T_scene_solid.rotate(Eigen::AngleAxisd(std::numbers::pi / 4, Eigen::Vector3d::UnitY()));
  box.T_scene_solid.translation().z() = 0.06 / std::numbers::sqrt2;
  return on_table({box});
}

TEST(LabelJudge, WhatHoldsIsValid) {
  const Verdict box = verdict(box_on_table(), on_box());
  EXPECT_TRUE(box.valid()) << name(box.failure);
  EXPECT_EQ(box.object, 2);
  EXPECT_EQ(failure(cylinder_on_table(), from_above({0, 0, 0.12f}, 0.06f)), "");
  EXPECT_EQ(failure(lying_cylinder_on_table(), from_above({0, 0, 0.05f}, 0.05f, kPi / 2)), "");
}

TEST(LabelJudge, HalfATurnOfTheGripperChangesNothing) {
  EXPECT_EQ(failure(box_on_table(), from_above({0, 0, 0.08f}, 0.05f, kPi)), "");
}

TEST(LabelJudge, WhereTheSceneIsDoesNotMatter) {
  const Eigen::Isometry3d T = Eigen::Translation3d(1, -2, 3) *
                              Eigen::AngleAxisd(2.0, Eigen::Vector3d(1, 2, 3).normalized()) *
                              Eigen::Isometry3d::Identity();
  const AnalyticScene there = moved(box_on_table(), T);
  EXPECT_EQ(failure(there, transformed(on_box(), T.cast<float>())), "");
  EXPECT_EQ(failure(there, transformed(from_above({0, -0.052f, 0.045f}, 0.05f), T.cast<float>())), "palm");
}

TEST(LabelJudge, TheOrderOfThePointsDoesNotMatter) {
  const LabelledCloud organized = labelled(box_on_table());
  LabelledCloud reversed;
  reversed.cloud.viewpoint = organized.cloud.viewpoint;
  for (std::size_t i = organized.cloud.size(); i-- > 0;) {
    if (!organized.cloud.point(i).allFinite()) continue;
    reversed.cloud.push_back(organized.cloud.point(i));
    reversed.label.push_back(organized.label[i]);
  }
  reversed.cloud.width = static_cast<int>(reversed.cloud.size());
  EXPECT_TRUE(judge(LabelScene(reversed), {}, on_box()).valid());
}

TEST(LabelJudge, TargetIsOneObject) {
  EXPECT_EQ(failure(box_on_table(), from_above({0.15f, 0, 0.1f}, 0.03f)), "target");  // in the air
  EXPECT_EQ(failure(box_on_table(), from_above({0.15f, 0, 0}, 0.05f)), "target");     // the support
  AnalyticScene two =
      on_table({standing_box(-0.015, 0, {0.03, 0.1, 0.08}), standing_box(0.015, 0, {0.03, 0.1, 0.08})});
  EXPECT_EQ(failure(two, from_above({0, 0, 0.08f}, 0.06f)), "target");
}

TEST(LabelJudge, NumbersThatAreNoneHoldNothing) {
  Handle handle = on_box();
  handle.position.x() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(failure(box_on_table(), handle), "target");
  handle = on_box();
  handle.width_m = std::numeric_limits<float>::infinity();
  EXPECT_NE(failure(box_on_table(), handle), "");
  handle.width_m = -1;
  EXPECT_NE(failure(box_on_table(), handle), "");
  handle = on_box();
  handle.position.z() = 1e30f;
  EXPECT_EQ(failure(box_on_table(), handle), "target");
}

TEST(LabelJudge, TheObjectFitsBetweenTheJaws) {
  EXPECT_EQ(failure(too_wide_box(), from_above({0, 0, 0.1f}, 0.12f)), "fit");
  EXPECT_EQ(failure(box_on_table(), from_above({0, 0, 0.08f}, 0.03f)), "fit");  // says it is narrower
}

TEST(LabelJudge, FingersNeedRoom) {
  const auto crowded = with(box_on_table(), standing_box(0.045, 0, {0.03, 0.12, 0.08}));
  EXPECT_EQ(failure(crowded, on_box()), "fingers");
  const auto roomy = with(box_on_table(), standing_box(0.065, 0, {0.03, 0.12, 0.08}));
  EXPECT_EQ(failure(roomy, on_box()), "");
}

TEST(LabelJudge, ThePalmStopsAtTheObject) {
  // Where the front is seen between the jaws.
  EXPECT_EQ(failure(box_on_table(), from_above({0, -0.052f, 0.045f}, 0.05f)), "palm");
}

TEST(LabelJudge, FingertipsStayAboveTheSupportAlsoWhereItIsNotMeasured) {
  const AnalyticScene flat = on_table({standing_box(0, 0, {0.05, 0.12, 0.02})});
  EXPECT_EQ(judge(without_support_nearby(flat), {}, from_above({0, 0, 0.02f}, 0.05f)).failure,
            JudgeFailure::kSupport);
}

TEST(LabelJudge, SlantedSidesSlip) {
  const AnalyticScene narrow = on_table({standing_box(0, 0, {0.025, 0.12, 0.08})});
  EXPECT_EQ(failure(narrow, from_above({0, 0, 0.08f}, 0.025f)), "");
  const float slanted = 0.025f * std::numbers::sqrt2_v<float> + 0.02f;
  EXPECT_EQ(failure(narrow, from_above({0, 0, 0.08f}, slanted, kPi / 4)), "sides");
}

TEST(LabelJudge, ACornerInTheEndOfTheFingersIsNoGrip) {
  Handle handle = from_above({-0.064f, -0.064f, 0.1f}, 0.02f, 2.0f);
  const Verdict v = verdict(too_wide_box(), handle);
  EXPECT_FALSE(v.valid());
}

TEST(LabelJudge, JawsSlideOffAWedge) {
  const float top = 0.06f * std::numbers::sqrt2_v<float>;
  EXPECT_EQ(failure(ridge(), from_above({0, 0, top}, 0.065f)), "walls");
}

TEST(LabelJudge, AThinPlateIsNoContact) {
  Gripper shallow;
  shallow.grasp_depth_m = 0.010f;
  const AnalyticScene plate = on_table({standing_box(0, 0, {0.05, 0.12, 0.008})});
  EXPECT_EQ(judge(without_support_nearby(plate), shallow, from_above({0, 0, 0.008f}, 0.05f)).failure,
            JudgeFailure::kContact);
}

TEST(LabelJudge, AnOcclusionBorderIsNoEdge) {
  // The camera looks down at a long box; a slab between both hides all but 60 mm of it.
  AnalyticScene scene = on_table({standing_box(0, 0, {0.3, 0.12, 0.08})});
  scene.camera.T_scene_camera = looking_at({0, -0.05, 0.7}, {0, 0, 0});
  for (const double side : {-1.0, 1.0}) {
    AnalyticSolid slab = standing_box(side * 0.090, -0.01, {0.12, 0.3, 0.01});
    slab.T_scene_solid.translation().z() = 0.19;
    scene.solids.push_back(slab);
  }
  const Verdict v = verdict(scene, from_above({0, -0.01f, 0.08f}, 0.07f));
  EXPECT_FALSE(v.valid());
  EXPECT_TRUE(v.failure == JudgeFailure::kContact) << name(v.failure);
}

TEST(LabelJudge, FingersKeepOutOfHiddenSpace) {
  // Something floats between the sensor and the upper part of the far finger's place.
  Gripper slender;
  slender.finger_length_m = 0.1f;
  const AnalyticScene box = on_table({standing_box(0, 0, {0.12, 0.05, 0.08})});
  const Handle handle = from_above({0, 0, 0.08f}, 0.05f, kPi / 2);
  EXPECT_EQ(failure(box, handle, slender), "");
  const Verdict v = verdict(with(box, floating_box({0, -0.1, 0.27}, 0.05)), handle, slender);
  EXPECT_EQ(name(v.failure), "unseen");
  EXPECT_GT(std::max(v.hidden_share[0], v.hidden_share[1]), 0.5f);
  EXPECT_FALSE(v.both_fingers_hidden());
}

TEST(LabelJudge, TheHandNeedsAWayIn) {
  const auto roofed = with(box_on_table(), floating_box({0, 0.01, 0.21}, 0.03));
  EXPECT_EQ(failure(roofed, on_box()), "way");
}

TEST(LabelJudge, TheWayInKeepsAboveTheSupport) {
  // From below the horizon, at a box on the edge of nothing: fingertips are free, the hand behind them is
  // not.
  Handle handle;
  const float tilt = -0.45f;
  handle.rotation.col(1) = Eigen::Vector3f::UnitX();
  handle.rotation.col(2) = Eigen::Vector3f(0, std::cos(tilt), -std::sin(tilt));
  handle.rotation.col(0) = handle.rotation.col(1).cross(handle.rotation.col(2));
  handle.position = {0, -0.06f, 0.05f};
  handle.width_m = 0.05f;
  EXPECT_EQ(failure(box_on_table(), handle), "way");
}

TEST(LabelJudge, EveryFailureHasAName) {
  std::set<std::string_view> names;
  for (int f = 0; f < static_cast<int>(JudgeFailure::kNone); ++f)
    names.insert(name(static_cast<JudgeFailure>(f)));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(JudgeFailure::kNone));
  EXPECT_FALSE(names.contains(""));
}

}  // namespace
}  // namespace graspd

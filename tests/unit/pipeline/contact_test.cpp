// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/scene_gallery.hpp"
#include "tests/unit/pipeline/check_scene.hpp"

namespace graspd {
namespace {

const Eigen::Vector3f kDown = -Eigen::Vector3f::UnitZ();
const Eigen::Vector3f kAcross = Eigen::Vector3f::UnitX();  // the line of sight
const Eigen::Vector3f kAlong = Eigen::Vector3f::UnitY();   // away from the camera

TEST(Contact, NothingBetweenTheJaws) {
  const CheckScene scene(box_on_table());
  for (const Contact& contact : scene.contacts(scene.candidate({0, 0, 0.3f}, kDown, kAcross)))
    EXPECT_EQ(contact.kind, ContactKind::kNone);
}

TEST(Contact, BothSidesOfABoxFromTheFrontAreFreeEdges) {
  // The camera sees past either side, but not the sides themselves.
  const CheckScene scene(box_on_table());
  const auto [low, high] = scene.contacts(scene.candidate({0, 0, 0.08f}, kDown, kAcross));
  EXPECT_EQ(low.kind, ContactKind::kFreeEdge);
  EXPECT_EQ(high.kind, ContactKind::kFreeEdge);
  EXPECT_NEAR(low.reach_m, -0.025f, 0.002f);
  EXPECT_NEAR(high.reach_m, 0.025f, 0.002f);
}

TEST(Contact, AFlatTopIsFlatFromWhicheverSideTheHandComes) {
  // Tilted about the closing axis, depths differ along the major axis: that is no curve of the face.
  for (const double width : {0.015, 0.03, 0.05}) {
    const CheckScene scene(on_table({standing_box(0, 0, {width, 0.11, 0.07})}));
    for (const float tilt : {0.3f, 0.6f, 0.8f}) {
      SCOPED_TRACE(width);
      SCOPED_TRACE(tilt);
      const Eigen::Vector3f approach(0, std::sin(tilt), -std::cos(tilt));
      const auto half = static_cast<float>(width / 2);
      const auto [low, high] = scene.contacts(scene.candidate({0, 0, 0.07f}, approach, kAcross));
      EXPECT_EQ(low.kind, ContactKind::kFreeEdge);
      EXPECT_EQ(high.kind, ContactKind::kFreeEdge);
      EXPECT_NEAR(low.reach_m, -half, 0.002f);
      EXPECT_NEAR(high.reach_m, half, 0.002f);
    }
  }
}

TEST(Contact, TheFrontOfABoxIsAWallAndItsBackAFlatEdge) {
  const CheckScene scene(on_table({standing_box(0, 0, {0.12, 0.05, 0.08})}));
  const auto [front, back] = scene.contacts(scene.candidate({0, 0, 0.08f}, kDown, kAlong));
  EXPECT_EQ(front.kind, ContactKind::kWall);
  EXPECT_LT((front.normal - Eigen::Vector3f(0, -1, 0)).norm(), 0.1f);
  EXPECT_NEAR(front.reach_m, -0.025f, 0.002f);
  EXPECT_EQ(back.kind, ContactKind::kFlatEdge);
  EXPECT_TRUE(back.normal.isZero());
  EXPECT_NEAR(back.reach_m, 0.025f, 0.003f);
}

TEST(Contact, TheBackOfACylinderReachesItsRadius) {
  for (const double radius : {0.018, 0.022, 0.026, 0.032}) {
    SCOPED_TRACE(radius);
    const CheckScene scene(on_table({lying_cylinder(0, 0, radius, 0.14)}));
    const auto r = static_cast<float>(radius);
    const auto [front, back] = scene.contacts(scene.candidate({0, 0, 2 * r}, kDown, kAlong));
    EXPECT_EQ(front.kind, ContactKind::kWall);
    EXPECT_NEAR(front.reach_m, -r, 0.002f);
    EXPECT_EQ(back.kind, ContactKind::kCurvedEdge);
    EXPECT_GT(back.reach_m, r - 0.002f) << "the finger would hit it";
    EXPECT_LT(back.reach_m, r + 0.007f);
  }
}

TEST(Contact, ARoundThingMetFarAboveItsWidestPlaceIsNotHeld) {
  const CheckScene scene(on_table({lying_cylinder(0, 0, 0.05, 0.16)}));
  Gripper shallow, deep;
  shallow.grasp_depth_m = 0.018f;
  deep.grasp_depth_m = 0.050f;
  deep.aperture_m = shallow.aperture_m = 0.12f;
  const Candidate top = scene.candidate({0, 0, 0.10f}, kDown, kAlong);
  EXPECT_EQ(scene.contacts(top, shallow)[1].kind, ContactKind::kNone);
  EXPECT_EQ(scene.contacts(top, deep)[1].kind, ContactKind::kCurvedEdge);
}

TEST(Contact, AThingThatTheSensorSeesPastIsNoWiderThanWhatIsSeen) {
  // The seen half of a rod is part of a circle that says nothing about what is beside it.
  for (const double radius : {0.008, 0.010, 0.0125}) {
    SCOPED_TRACE(radius);
    const CheckScene scene(on_table({standing_cylinder(0, 0, radius, 0.10)}));
    const auto r = static_cast<float>(radius);
    const auto [low, high] = scene.contacts(scene.candidate({0, 0, 0.10f}, kDown, kAcross));
    EXPECT_EQ(low.kind, ContactKind::kFreeEdge);
    EXPECT_EQ(high.kind, ContactKind::kFreeEdge);
    EXPECT_NEAR(low.reach_m, -r, 0.0015f);
    EXPECT_NEAR(high.reach_m, r, 0.0015f);
  }
}

TEST(Contact, TheBackOfAPlateIsAThinEdge) {
  const CheckScene scene(on_table({standing_box(0, 0, {0.12, 0.006, 0.08})}));
  const auto [front, back] = scene.contacts(scene.candidate({0, 0, 0.08f}, kDown, kAlong));
  EXPECT_EQ(front.kind, ContactKind::kWall);
  EXPECT_EQ(back.kind, ContactKind::kThinEdge);
  EXPECT_NEAR(front.reach_m, -0.003f, 0.002f);
  EXPECT_NEAR(back.reach_m, 0.003f, 0.002f);
}

TEST(Contact, WhereSomethingNearerHidesTheRestIsNoEdge) {
  // A tall box close to the camera hides the right part of a wide one.
  const AnalyticSolid wide = standing_box(0, 0.06, {0.12, 0.06, 0.06});
  const AnalyticSolid before = standing_box(0.045, -0.06, {0.08, 0.02, 0.20});
  const CheckScene hidden(on_table({wide, before})), open(on_table({wide}));
  const Eigen::Vector3f top(-0.03f, 0.06f, 0.06f);
  const auto cut = hidden.contacts(hidden.candidate(top, kDown, kAcross));
  const auto whole = open.contacts(open.candidate(top, kDown, kAcross));
  EXPECT_NE(whole[0].kind, ContactKind::kNone);
  EXPECT_NE(cut[0].kind, ContactKind::kNone) << "the other side is as it was";
  EXPECT_EQ(cut[1].kind, ContactKind::kNone);
  EXPECT_LT(cut[1].reach_m, whole[1].reach_m - 0.01f) << "what is seen of it ends before it does";
}

TEST(Contact, NothingHoldsOnARoof) {
  // A box that stands on an edge: both faces fall away by 45 degrees.
  AnalyticSolid roof = standing_box(0, 0, {0.07, 0.12, 0.07});
  roof.T_scene_solid.rotate(Eigen::AngleAxisd(std::numbers::pi / 4, Eigen::Vector3d::UnitY()));
  const double ridge = 0.035 * std::sqrt(2.0);
  roof.T_scene_solid.translation().z() = ridge;
  const CheckScene scene(on_table({roof}));
  const Eigen::Vector3f top(0, 0, 2 * static_cast<float>(ridge));
  for (const Contact& contact : scene.contacts(scene.candidate(top, kDown, kAcross)))
    EXPECT_EQ(contact.kind, ContactKind::kNone);
}

}  // namespace
}  // namespace graspd

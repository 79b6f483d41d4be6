// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/solid_judge.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "client/simulate/rng.hpp"
#include "tests/unit/evaluate/solid_scenes.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;

constexpr double kRadians = std::numbers::pi / 180;
const Box kBlock{{0, 0, 0.04}, {0.02, 0.03, 0.04}};  // 40 x 60 x 80 mm, standing on z = 0

Scene block_on_table(double yaw_rad = 0) {
  Scene scene = bare_table();
  add_body(scene, kBlock, Vector3d::Zero(), yaw_rad);
  return scene;
}

std::string judged(const Scene& scene, const Handle& handle) {
  return std::string(name(judge_on_solids(scene, handle, Gripper{}).failure));
}

TEST(SolidJudge, HoldsABlock) {
  const SolidVerdict verdict =
      judge_on_solids(block_on_table(), handle_from_above(0.001, 0, 0.05, 0.042), Gripper{});
  EXPECT_EQ(name(verdict.failure), "none");
  EXPECT_TRUE(verdict.holds());
  EXPECT_EQ(verdict.solid, 1u);
  EXPECT_NEAR(verdict.width_m, 0.040, 1e-6);
  EXPECT_NEAR(verdict.off_center_m, -0.001, 1e-6);
  EXPECT_NEAR(verdict.depth_m, 0.030, 0.002);
  EXPECT_NEAR(verdict.contact_deg[0], 0, 0.1);
  EXPECT_NEAR(verdict.contact_m2[1], 0.020 * 0.030, 0.020 * 0.002);
  EXPECT_NEAR(verdict.line_deg, 0, 0.1);
}

TEST(SolidJudge, HoldsRoundThings) {
  Scene standing = bare_table();
  add_body(standing, Cylinder{0.03, 0, 0.12}, Vector3d::Zero());
  EXPECT_EQ(judged(standing, handle_from_above(0, 0, 0.09, 0.060)), "none");
  Scene ball = bare_table();
  add_body(ball, Ball{{0, 0, 0.03}, 0.03}, Vector3d::Zero());
  EXPECT_EQ(judged(ball, handle_from_above(0, 0, 0.02, 0.060)), "none");
  Scene pen = bare_table();
  add_body(pen, Capsule{{0, -0.06, 0.006}, {0, 0.06, 0.006}, 0.006}, Vector3d::Zero());
  EXPECT_EQ(judged(pen, handle_from_above(0, 0, 0.001, 0.012)), "none");
}

TEST(SolidJudge, HoldsTheRimOfABowl) {
  Scene scene = bare_table();
  add_body(scene, BallSlice{0.07, -0.068, 0}, {0, 0, 0.068});
  scene.solids[1].cavity = Ball{Vector3d::Zero(), 0.065};
  EXPECT_EQ(judged(scene, handle_from_above(0.0675, 0, 0.05, 0.006)), "none");
  EXPECT_EQ(judged(scene, handle_from_above(0, 0.0675, 0.05, 0.006)), "finger") << "along the rim";
  EXPECT_EQ(judged(scene, handle_from_above(0, 0, 0.05, 0.072)), "nothing") << "within the bowl";
}

TEST(SolidJudge, HoldsTheRimOfACup) {
  Scene scene = bare_table();
  add_body(scene, Cylinder{0.036, 0, 0.09}, Vector3d::Zero());
  scene.solids[1].cavity = Cylinder{0.032, 0.004, 0.2};
  EXPECT_EQ(judged(scene, handle_from_above(0.034, 0, 0.065, 0.005)), "none");
  EXPECT_EQ(judged(scene, handle_from_above(0, 0, 0.065, 0.072)), "none")
      << "from outside, across the hollow";
}

TEST(SolidJudge, AFingerMustNotGoIntoAnything) {
  Scene scene = block_on_table();
  add_body(scene, kBlock, {0.046, 0, 0});
  EXPECT_EQ(judged(scene, handle_from_above(0, 0, 0.05, 0.040)), "finger") << "6 mm beside it";
  EXPECT_EQ(judged(block_on_table(), handle_from_above(0, 0, 0.05, 0.029)), "finger") << "the object itself";
  EXPECT_EQ(judged(block_on_table(), handle_from_above(0, 0, 0.05, 0.0305)), "none") << "less than 1 mm deep";
}

TEST(SolidJudge, PalmAndHandMustComeInFree) {
  Scene post = block_on_table();
  add_body(post, Box{{0, 0, 0.1}, {0.004, 0.004, 0.1}}, {0.045, 0, 0});
  EXPECT_EQ(judged(post, handle_from_above(0, 0, 0.05, 0.040)), "palm");
  Scene shelf = block_on_table();
  add_body(shelf, Box{{0, 0, 0.16}, {0.1, 0.1, 0.005}}, Vector3d::Zero());
  EXPECT_EQ(judged(shelf, handle_from_above(0, 0, 0.05, 0.040)), "way") << "45 mm above the fingers' roots";
  Scene high = block_on_table();
  add_body(high, Box{{0, 0, 0.24}, {0.1, 0.1, 0.005}}, Vector3d::Zero());
  EXPECT_EQ(judged(high, handle_from_above(0, 0, 0.05, 0.040)), "none");
}

TEST(SolidJudge, FingertipsStayAboveTheSupport) {
  Scene low = bare_table();
  add_body(low, Box{{0, 0, 0.02}, {0.02, 0.03, 0.02}}, Vector3d::Zero());
  EXPECT_EQ(judged(low, handle_from_above(0, 0, 0.0, 0.040)), "none");
  EXPECT_EQ(judged(low, handle_from_above(0, 0, -0.002, 0.040)), "support");
}

TEST(SolidJudge, JawsMustNotCloseOnTheSupport) {
  Scene scene = bare_table();
  add_body(scene, Box{{0, 0, 0.01}, {0.025, 0.025, 0.01}}, Vector3d::Zero());
  scene.solids[1].label = kLabelSupport;
  add_body(scene, Cylinder{0.02, 0, 0.05}, {0, 0, 0.02});
  EXPECT_EQ(judged(scene, handle_from_above(0, 0, 0.021, 0.044)), "none");
  EXPECT_EQ(judged(scene, handle_from_above(0, 0, 0.012, 0.044)), "support") << "beside the pedestal's top";
}

TEST(SolidJudge, SomethingMustBeThere) {
  EXPECT_EQ(judged(bare_table(), handle_from_above(0, 0, 0.05, 0.040)), "nothing");
  EXPECT_EQ(judged(block_on_table(), handle_from_above(0, 0, 0.082, 0.040)), "nothing") << "above it";
}

TEST(SolidJudge, BothJawsMustMeetTheSameThing) {
  Scene pair = bare_table();
  const Box half{{0, 0, 0.04}, {0.012, 0.03, 0.04}};
  add_body(pair, half, {-0.0125, 0, 0});
  add_body(pair, half, {0.0125, 0, 0});
  EXPECT_EQ(judged(pair, handle_from_above(0, 0, 0.05, 0.049)), "two_objects");
  // What is between the jaws without touching them is no matter.
  Scene inner = bare_table();
  add_body(inner, Cylinder{0.02, 0, 0.08}, {0, 0.008, 0});
  add_body(inner, Ball{{0, 0, 0.07}, 0.005}, {0, -0.018, 0});
  EXPECT_EQ(judged(inner, handle_from_above(0, -0.005, 0.055, 0.040)), "none");
}

TEST(SolidJudge, AWallOfTheBinIsNoObject) {
  Scene scene = bare_table();
  add_body(scene, Box{{0, 0, 0.05}, {0.004, 0.2, 0.05}}, Vector3d::Zero());
  scene.solids[1].label = kLabelBinWall;
  EXPECT_EQ(judged(scene, handle_from_above(0, 0, 0.08, 0.008)), "fixed");
}

TEST(SolidJudge, AnObjectIsNotPushedFar) {
  EXPECT_EQ(judged(block_on_table(), handle_from_above(0.0045, 0, 0.05, 0.060)), "none");
  EXPECT_EQ(judged(block_on_table(), handle_from_above(0.0055, 0, 0.05, 0.060)), "off_center");
}

TEST(SolidJudge, AnObjectMustReachBetweenTheJaws) {
  EXPECT_EQ(judged(block_on_table(), handle_from_above(0, 0, 0.070, 0.040)), "none");
  EXPECT_EQ(judged(block_on_table(), handle_from_above(0, 0, 0.074, 0.040)), "shallow");
}

TEST(SolidJudge, SteepWallsSlipOut) {
  // A ball of 30 mm held 12 mm below its top: the pads meet it 37 degrees above their normal.
  Scene ball = bare_table();
  add_body(ball, Ball{{0, 0, 0.03}, 0.03}, Vector3d::Zero());
  EXPECT_EQ(judged(ball, handle_from_above(0, 0, 0.048, 0.050)), "friction");
  const Handle handle = handle_from_above(0, 0, 0.048, 0.050);
  SolidJudgeConfig sticky;
  sticky.friction = 1.0;
  EXPECT_EQ(name(judge_on_solids(ball, handle, Gripper{}, sticky).failure), "none");
}

TEST(SolidJudge, EdgesAreNoWalls) {
  // A square post by its corners: the mean normals are straight, what is touched is not.
  Scene post = bare_table();
  add_body(post, Box{{0, 0, 0.05}, {0.02, 0.02, 0.05}}, Vector3d::Zero(), 45 * kRadians);
  EXPECT_EQ(judged(post, handle_from_above(0, 0, 0.07, 0.0566)), "contact");
}

TEST(SolidJudge, ContactsMustFaceEachOther) {
  Scene book = bare_table();
  add_body(book, Box{{0, 0, 0.05}, {0.008, 0.06, 0.05}}, Vector3d::Zero(), 18 * kRadians);
  EXPECT_EQ(judged(book, handle_from_above(0, 0, 0.07, 0.028)), "opposite");
  Scene straight = bare_table();
  add_body(straight, Box{{0, 0, 0.05}, {0.008, 0.06, 0.05}}, Vector3d::Zero(), 5 * kRadians);
  EXPECT_EQ(judged(straight, handle_from_above(0, 0, 0.07, 0.018)), "none");
}

TEST(SolidJudge, TheApertureLimitsTheOpening) {
  Scene wide = bare_table();
  add_body(wide, Box{{0, 0, 0.04}, {0.0395, 0.03, 0.04}}, Vector3d::Zero());
  EXPECT_EQ(judged(wide, handle_from_above(0, 0, 0.05, 0.079)), "none");
  add_body(wide, kBlock, {0, 0.2, 0});
  Gripper small;
  small.aperture_m = 0.06f;
  EXPECT_EQ(name(judge_on_solids(wide, handle_from_above(0, 0, 0.05, 0.079), small).failure), "finger");
}

TEST(SolidJudge, ACommonMotionChangesNothing) {
  Rng rng(3);
  Scene scene = block_on_table(0.3);
  add_body(scene, Cylinder{0.02, 0, 0.1}, {0.06, 0.01, 0});
  add_body(scene, Ball{{0, 0, 0.025}, 0.025}, {-0.05, 0.03, 0});
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = Vector3d(0.4, -1.2, 0.7);
  T.rotate(Eigen::AngleAxisd(2.1, Vector3d(1, -2, 0.5).normalized()));
  Scene moved = scene;
  for (Solid& solid : moved.solids) solid.T_world_solid = T * solid.T_world_solid;
  int held = 0, same = 0;
  constexpr int kTries = 2000;
  for (int i = 0; i < kTries; ++i) {
    const Solid& at = scene.solids[static_cast<std::size_t>(1 + rng.index(3))];
    const Vector3d offset(rng.uniform(-0.01, 0.01), rng.uniform(-0.01, 0.01), rng.uniform(0.03, 0.1));
    const Vector3d approach(rng.uniform(-0.3, 0.3), rng.uniform(-0.3, 0.3), -1);
    const Handle handle = handle_at(at.T_world_solid.translation() + offset, approach,
                                    {rng.uniform(-1, 1), rng.uniform(-1, 1), 0}, rng.uniform(0.03, 0.07));
    const SolidVerdict a = judge_on_solids(scene, handle, Gripper{});
    const SolidVerdict b = judge_on_solids(moved, transformed(handle, T.cast<float>()), Gripper{});
    held += a.holds() ? 1 : 0;
    same += a.failure == b.failure && a.solid == b.solid ? 1 : 0;
  }
  EXPECT_GT(held, 50);
  // Handles are single precision: some are on the very border.
  EXPECT_GE(same, kTries - 10);
}

TEST(SolidJudge, SaysWhy) {
  Scene scene = block_on_table();
  const auto text = [&] {
    return judge_on_solids(scene, handle_from_above(0, 0, 0.05, 0.040), Gripper{}).text(scene);
  };
  EXPECT_EQ(
      text(),
      "none; object body 20; blocked by -; width 40.0 mm, off centre 0.0 mm, depth 30.0 mm, contacts 0 and 0 "
      "degrees, 600 and 600 mm2, line 0 degrees");
  add_body(scene, kBlock, {0.046, 0, 0});
  EXPECT_EQ(text(), "finger; object -; blocked by body 30");
}

}  // namespace
}  // namespace graspd

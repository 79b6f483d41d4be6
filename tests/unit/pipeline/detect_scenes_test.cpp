// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// detect_handles on scenes with exact answers: the handles there must be, and those there must not.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "service/pipeline/detect_handles.hpp"
#include "tests/support/clouds.hpp"
#include "tests/support/handle_truth.hpp"
#include "tests/support/scene_gallery.hpp"

namespace graspd {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

struct Detected {
  AnalyticScene scene;
  Gripper gripper;
  DetectConfig config;
  Detection detection;
  std::vector<HandleTruth> truth;  ///< of each handle

  [[nodiscard]] int num_on(int solid) const {
    int n = 0;
    for (const HandleTruth& t : truth) n += t.solid == solid ? 1 : 0;
    return n;
  }
  [[nodiscard]] const std::pmr::vector<Handle>& handles() const { return detection.handles; }
};

Detected detect(const AnalyticScene& scene, const Gripper& gripper = {}) {
  Detected d;
  d.scene = scene;
  d.gripper = gripper;
  d.detection = detect_handles(render(scene).cloud, gripper, d.config);
  for (const Handle& handle : d.handles()) d.truth.push_back(judge(handle, gripper, d.config.check, scene));
  return d;
}

void expect_frame(const Handle& handle, const Eigen::Vector3f& viewpoint) {
  EXPECT_LT((handle.rotation.transpose() * handle.rotation - Eigen::Matrix3f::Identity()).norm(), 1e-4f);
  EXPECT_NEAR(handle.rotation.determinant(), 1, 1e-4) << "right-handed";
  EXPECT_GT(handle.rotation.col(2).dot(handle.position - viewpoint), 0)
      << "the hand comes from the sensor's side";
  EXPECT_GE(handle.score, 0);
  EXPECT_LE(handle.score, 1);
}

/// What holds for every handle of every scene. least_grip_m: how deep what is held must reach between the
/// jaws.
void expect_sound(const Detected& d, const Handle& handle, const HandleTruth& truth, double least_grip_m) {
  expect_frame(handle, d.scene.camera.T_scene_camera.translation().cast<float>());
  EXPECT_GE(truth.solid, 1) << "not on the table";
  EXPECT_EQ(truth.num_between, 1) << "one object between the jaws";
  // Where a side is out of sight, the clearance is what the width may be wrong by before a finger touches it.
  EXPECT_NEAR(handle.width_m, truth.width_m, d.config.check.clearance_m);
  EXPECT_LE(truth.width_m, d.gripper.aperture_m);
  EXPECT_LT(std::abs(truth.center_m), 0.003) << "the object is in the middle between the jaws";
  EXPECT_LT(truth.finger_depth_m, 0.0005) << "the fingers come in without touching anything";
  EXPECT_LT(truth.hand_depth_m, 0.0005) << "nothing is in the way of the hand";
  // A finger that would hit the table goes less deep, but not so little that it does not hold.
  EXPECT_GT(truth.grip_depth_m, least_grip_m - 0.003);
}

void expect_all_sound(const Detected& d, double least_grip_m = HandleCheckConfig{}.min_grip_depth_m) {
  std::set<int> seen;
  for (std::size_t i = 0; i < d.handles().size(); ++i) {
    SCOPED_TRACE("handle " + std::to_string(i) + " on solid " + std::to_string(d.truth[i].solid));
    expect_sound(d, d.handles()[i], d.truth[i], least_grip_m);
    if (seen.insert(d.truth[i].solid).second) {
      EXPECT_GT(d.handles()[i].width_m, d.truth[i].width_m - 0.003)
          << "the best of its object: a wider opening costs room, one too narrow the grip";
    }
  }
}

void expect_nothing(const Detected& d) {
  EXPECT_EQ(d.detection.status, DetectionStatus::kNoHandles);
  EXPECT_TRUE(d.handles().empty());
  int failed = 0;
  for (const int n : d.detection.candidate_failures) failed += n;
  EXPECT_EQ(failed, d.detection.num_candidates) << "every candidate has its reason";
}

/// Angle between a handle's closing axis and a direction, as lines [rad].
double closing_angle(const Handle& handle, const Eigen::Vector3d& direction) {
  return std::acos(
      std::min(1.0, std::abs(handle.rotation.col(1).cast<double>().dot(direction.normalized()))));
}

TEST(DetectScenes, BoxOnTable) {
  const Detected d = detect(box_on_table());
  EXPECT_EQ(d.detection.status, DetectionStatus::kOk);
  expect_all_sound(d);
  ASSERT_GE(d.num_on(1), 1);
  for (const Handle& handle : d.handles())
    EXPECT_LT(closing_angle(handle, Eigen::Vector3d::UnitX()), 25 * kDegree)
        << "120 mm and, on the table, 80 mm are too wide";
  EXPECT_LT(closing_angle(d.handles()[0], Eigen::Vector3d::UnitX()), 8 * kDegree);
  EXPECT_NEAR(d.handles()[0].width_m, 0.05, 0.003);
}

TEST(DetectScenes, TurnedBoxes) {
  for (const double yaw : {-70.0, -35.0, 20.0, 50.0, 90.0}) {
    SCOPED_TRACE(yaw);
    const Detected d = detect(on_table({standing_box(0, 0, {0.05, 0.11, 0.07}, yaw * kDegree)}));
    expect_all_sound(d);
    ASSERT_GE(d.num_on(1), 1);
    const Eigen::Vector3d narrow(std::cos(yaw * kDegree), std::sin(yaw * kDegree), 0);
    EXPECT_LT(closing_angle(d.handles()[0], narrow), 15 * kDegree);
  }
}

TEST(DetectScenes, StandingCylinder) {
  const Detected d = detect(cylinder_on_table());
  expect_all_sound(d);
  ASSERT_GE(d.num_on(1), 1);
  // Across the axis whatever the approach; it must go through the middle.
  EXPECT_LT(std::abs(d.handles()[0].rotation(2, 1)), std::sin(10 * kDegree));
  EXPECT_NEAR(d.handles()[0].width_m, 0.06, 0.003);
}

TEST(DetectScenes, LyingCylinder) {
  const Detected d = detect(lying_cylinder_on_table());
  expect_all_sound(d);
  ASSERT_GE(d.num_on(1), 1);
  for (const Handle& handle : d.handles())
    EXPECT_GT(closing_angle(handle, Eigen::Vector3d::UnitX()), 65 * kDegree) << "140 mm are too long";
}

TEST(DetectScenes, LyingPens) {
  for (const double radius : {0.006, 0.007, 0.009})
    for (const double yaw : {-60.0, -20.0, 10.0, 40.0, 80.0}) {
      SCOPED_TRACE(radius);
      SCOPED_TRACE(yaw);
      const Detected d = detect(on_table({lying_cylinder(0, 0, radius, 0.14, yaw * kDegree)}));
      expect_all_sound(d, d.config.check.min_grip_share * 2 * radius);
      ASSERT_GE(d.num_on(1), 1);
      const Eigen::Vector3d along(std::cos(yaw * kDegree), std::sin(yaw * kDegree), 0);
      for (const Handle& handle : d.handles()) EXPECT_GT(closing_angle(handle, along), 75 * kDegree);
    }
}

TEST(DetectScenes, ABottleBesideABoxIsTakenAboveTheBox) {
  const Detected d = detect(bottle_beside_box());
  expect_all_sound(d);
  ASSERT_GE(d.num_on(1), 1) << "the bottle";
  EXPECT_EQ(d.num_on(2), 0) << "the box is 150 mm x 120 mm x 70 mm, and stands on the table";
  // From the left or the front there is room below the box's top too, but not for a finger between the two.
  for (const Handle& handle : d.handles())
    if (closing_angle(handle, Eigen::Vector3d::UnitX()) < 45 * kDegree) {
      EXPECT_GT(handle.position.z(), 0.07f);
    }
}

TEST(DetectScenes, ABottleApartFromTheBoxCanBeTakenLower) {
  const Detected apart =
      detect(on_table({standing_cylinder(-0.09, 0, 0.03, 0.18), standing_box(0.07, 0, {0.14, 0.12, 0.07})}));
  expect_all_sound(apart);
  EXPECT_GE(apart.num_on(1), 1);
}

TEST(DetectScenes, OfTouchingBoxesTheHigherOneIsTaken) {
  const Detected d = detect(touching_boxes());
  expect_all_sound(d);
  EXPECT_GE(d.num_on(1), 1);
  EXPECT_EQ(d.num_on(2), 0) << "there is no room for a finger beside the lower one";
}

TEST(DetectScenes, NothingOnAWideBox) {
  expect_nothing(detect(too_wide_box()));
}

TEST(DetectScenes, NothingOnABoxWedgedBetweenOthers) {
  const Detected d = detect(wedged_boxes());
  expect_all_sound(d);
  EXPECT_EQ(d.num_on(2), 0);
}

TEST(DetectScenes, NothingOnAWallOfBoxes) {
  expect_nothing(detect(wall_of_boxes()));
}

TEST(DetectScenes, ThingsOnSeveralLevels) {
  const Detected d = detect(block_on_table());
  expect_all_sound(d);
  EXPECT_EQ(d.num_on(1), 0) << "the block";
  for (const int solid : {2, 3, 4}) EXPECT_GE(d.num_on(solid), 1) << solid;
}

TEST(DetectScenes, ThingsInAShelf) {
  const Detected d = detect(shelf());
  for (std::size_t i = 0; i < d.handles().size(); ++i)
    expect_sound(d, d.handles()[i], d.truth[i], d.config.check.min_grip_depth_m);
  EXPECT_EQ(d.num_on(1) + d.num_on(2), 0) << "the upper board and the wall";
  for (const int solid : {3, 4, 5, 6}) EXPECT_GE(d.num_on(solid), 1) << solid;
}

TEST(DetectScenes, NothingOnAnEmptyTable) {
  expect_nothing(detect(on_table({})));
}

TEST(DetectScenes, NothingOnAFlatThing) {
  // 4 mm high: less than the gripper needs to hold anything.
  expect_nothing(detect(on_table({standing_box(0, 0, {0.05, 0.10, 0.004})})));
}

TEST(DetectScenes, NothingWhereTheGripperIsSmallerThanTheObject) {
  Gripper gripper;
  gripper.aperture_m = 0.045f;
  expect_nothing(detect(box_on_table(), gripper));
  expect_nothing(detect(cylinder_on_table(), gripper));
}

TEST(DetectScenes, ALargerGripperTakesTheWideBox) {
  Gripper gripper;
  gripper.aperture_m = 0.14f;
  const Detected d = detect(too_wide_box(), gripper);
  expect_all_sound(d);
  EXPECT_GE(d.num_on(1), 1);
}

TEST(DetectScenes, EveryObjectOfThree) {
  const Detected d = detect(three_objects());
  expect_all_sound(d);
  for (const int solid : {1, 2, 3}) EXPECT_GE(d.num_on(solid), 1) << "solid " << solid;
}

TEST(DetectScenes, EveryObjectOfNine) {
  const Detected d = detect(spread_objects());
  expect_all_sound(d);
  for (int solid = 1; solid <= 9; ++solid) EXPECT_GE(d.num_on(solid), 1) << "solid " << solid;
}

TEST(DetectScenes, ANarrowGapIsNoGap) {
  // Two boxes 6 mm apart: a finger is 10 mm wide. 30 mm apart there is room.
  const auto boxes = [](double gap) {
    return on_table({standing_box(-0.025 - gap / 2, 0, {0.05, 0.10, 0.07}),
                     standing_box(0.025 + gap / 2, 0, {0.05, 0.10, 0.07})});
  };
  const Detected close = detect(boxes(0.006)), apart = detect(boxes(0.03));
  expect_nothing(close);
  expect_all_sound(apart);
  EXPECT_GE(apart.num_on(1), 1);
  EXPECT_GE(apart.num_on(2), 1);
}

TEST(DetectScenes, BoxesOfManyWidths) {
  for (const double width : {0.015, 0.025, 0.035, 0.045, 0.055, 0.065, 0.072}) {
    SCOPED_TRACE(width);
    const Detected d = detect(on_table({standing_box(0, 0, {width, 0.11, 0.07})}));
    expect_all_sound(d);
    EXPECT_GE(d.num_on(1), 1);
  }
}

TEST(DetectScenes, ABoxThatTheImageCutsOffIsNotTakenForASmallOne) {
  // Too wide either way, but 5 cm of it is seen: the image ends 22 cm to the right of the middle.
  AnalyticScene scene = on_table({standing_box(0.25, 0, {0.16, 0.12, 0.06})});
  scene.camera = {looking_at({0, -0.5, 0.6}, {0, 0, 0}), 440, 360, 780};
  const AnalyticScene seen = moved(scene, scene.camera.T_scene_camera.inverse());
  const Detected cut_off = detect(seen);
  EXPECT_TRUE(cut_off.handles().empty());
  // One of the width that is seen is held.
  scene.solids[1] = standing_box(0.17, 0, {0.05, 0.12, 0.06});
  const Detected whole = detect(moved(scene, scene.camera.T_scene_camera.inverse()));
  EXPECT_GT(whole.num_on(1), 0);
  expect_all_sound(whole);
}

}  // namespace
}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/config/source_config.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "service/pipeline/handle.hpp"

namespace graspd {
namespace {

TEST(SensorPose, NoneIsIdentity) {
  EXPECT_FALSE(SensorPose{}.given());
  EXPECT_FALSE(SensorPose{}.validate());
  EXPECT_TRUE(SensorPose{}.T_target_cloud().matrix().isIdentity(0));
}

TEST(SensorPose, BothFormsOfARotationAgree) {
  // Roll 90 degrees: the cloud's y becomes the target's z.
  const double half = std::sqrt(0.5);
  SensorPose by_angles{"base", {1, 2, 3}, {}, {std::numbers::pi / 2, 0, 0}};
  SensorPose by_quaternion{"base", {1, 2, 3}, {half, half, 0, 0}, {}};
  const Eigen::Vector3f point(0, 1, 0);
  EXPECT_TRUE((by_angles.T_target_cloud() * point).isApprox(Eigen::Vector3f(1, 2, 4), 1e-6f));
  EXPECT_TRUE((by_quaternion.T_target_cloud() * point).isApprox(Eigen::Vector3f(1, 2, 4), 1e-6f));
}

TEST(SensorPose, AnglesAreThoseOfTheHandles) {
  const SensorPose pose{"base", {0, 0, 0}, {}, {0.3, -0.7, 2.1}};
  const Eigen::Vector3f rpy = roll_pitch_yaw(pose.T_target_cloud().linear());
  EXPECT_TRUE(rpy.isApprox(Eigen::Vector3f(0.3f, -0.7f, 2.1f), 1e-5f));
}

TEST(SensorPose, RoundedQuaternionsAreMadeUnit) {
  const SensorPose pose{"base", {0, 0, 0}, {0.707, 0, 0.707, 0}, {}};
  EXPECT_FALSE(pose.validate());
  EXPECT_NEAR(pose.T_target_cloud().linear().determinant(), 1, 1e-6);
}

TEST(SensorPose, WrongOnes) {
  EXPECT_EQ((SensorPose{"b", {0, 0, 0}, {1, 0, 0}, {}}).validate()->key, "quaternion_wxyz");
  EXPECT_EQ((SensorPose{"b", {0, 0, 0}, {1, 1, 0, 0}, {}}).validate()->key, "quaternion_wxyz");
  EXPECT_EQ((SensorPose{"b", {0, 0, 0}, {0, 0, 0, 0}, {}}).validate()->key, "quaternion_wxyz");
  EXPECT_EQ((SensorPose{"b", {0, 0, 0}, {}, {1, 2}}).validate()->key, "rpy_rad");
  EXPECT_EQ((SensorPose{"b", {0, 0, 0}, {1, 0, 0, 0}, {0, 0, 0}}).validate()->key, "rpy_rad");
  EXPECT_EQ((SensorPose{"", {0, 0, 1}, {}, {}}).validate()->key, "frame_name");
}

TEST(DegradeConfig, NeighbourhoodsGrowWithTheVoxels) {
  SourceConfig source;
  source.degrade.voxel_m = 2.0 * static_cast<double>(source.detect.downsample.leaf_size_m);
  EXPECT_FALSE(source.validate());
  const DetectConfig coarse = source.degraded_detect();
  EXPECT_FLOAT_EQ(coarse.downsample.leaf_size_m, 2 * source.detect.downsample.leaf_size_m);
  EXPECT_FLOAT_EQ(coarse.neighborhoods.radius_m, 2 * source.detect.neighborhoods.radius_m);
  EXPECT_FALSE(coarse.validate());
}

TEST(DegradeConfig, CoarserAndWithRoomBetweenTheLevels) {
  SourceConfig source;
  EXPECT_FALSE(source.validate()) << "off";
  source.degrade.voxel_m = static_cast<double>(source.detect.downsample.leaf_size_m);
  ASSERT_TRUE(source.validate());
  EXPECT_EQ(source.validate()->key, "degrade.voxel_m");
  EXPECT_FALSE(source.degrade.validate());
  source.degrade.below_ms = source.degrade.above_ms;
  ASSERT_TRUE(source.degrade.validate());
  EXPECT_EQ(source.degrade.validate()->key, "below_ms");
}

}  // namespace
}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/handle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace graspd {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

Eigen::Matrix3f from_rpy(const Eigen::Vector3f& rpy) {
  return (Eigen::AngleAxisf(rpy.z(), Eigen::Vector3f::UnitZ()) *
          Eigen::AngleAxisf(rpy.y(), Eigen::Vector3f::UnitY()) *
          Eigen::AngleAxisf(rpy.x(), Eigen::Vector3f::UnitX()))
      .toRotationMatrix();
}

void expect_consistent(const Eigen::Matrix3f& rotation, float tolerance = 5e-6f) {
  const Eigen::Quaternionf q = quaternion(rotation);
  EXPECT_NEAR(q.norm(), 1, 1e-6);
  EXPECT_GE(q.w(), 0);
  EXPECT_LT((q.toRotationMatrix() - rotation).cwiseAbs().maxCoeff(), tolerance);
  const Eigen::Vector3f rpy = roll_pitch_yaw(rotation);
  EXPECT_TRUE(rpy.allFinite());
  EXPECT_LE(std::abs(rpy.y()), kPi / 2 + 1e-6f);
  EXPECT_LT((from_rpy(rpy) - rotation).cwiseAbs().maxCoeff(), tolerance) << rpy.transpose();
}

TEST(Handle, RandomRotationsAgreeInAllForms) {
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  for (int k = 0; k < 2000; ++k)
    expect_consistent(Eigen::Quaternionf(normal(random), normal(random), normal(random), normal(random))
                          .normalized()
                          .toRotationMatrix());
}

TEST(Handle, RollPitchYawAreThoseOfTheRotation) {
  for (const Eigen::Vector3f& rpy :
       {Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(0.3f, -0.4f, 2), Eigen::Vector3f(-3, 1.5f, -3)})
    EXPECT_LT((roll_pitch_yaw(from_rpy(rpy)) - rpy).norm(), 2e-5f);
}

TEST(Handle, QuarterAndHalfTurns) {
  for (int roll = -2; roll <= 2; ++roll)
    for (int pitch = -1; pitch <= 1; ++pitch)
      for (int yaw = -2; yaw <= 2; ++yaw)
        expect_consistent(from_rpy(
            0.5f * kPi *
            Eigen::Vector3f(static_cast<float>(roll), static_cast<float>(pitch), static_cast<float>(yaw))));
}

TEST(Handle, NearTheGimbalLock) {
  for (const float sign : {-1.0f, 1.0f})
    for (const float away : {0.0f, 1e-4f, 1e-3f, 3e-3f})
      for (const float yaw : {-2.0f, 0.0f, 1.0f})
        for (const float roll : {-1.0f, 0.0f, 0.5f})
          expect_consistent(from_rpy({roll, sign * (kPi / 2 - away), yaw}));
}

TEST(Handle, AtTheGimbalLockTheDifferenceOfRollAndYawIsWhatCounts) {
  const Eigen::Vector3f rpy = roll_pitch_yaw(from_rpy({0.4f, kPi / 2, 0.1f}));
  EXPECT_NEAR(rpy.y(), kPi / 2, 1e-5);
  EXPECT_NEAR(rpy.x() - rpy.z(), 0.3f, 1e-5);
}

TEST(Handle, MovesAsAWhole) {
  Handle handle;
  handle.position = {1, 2, 3};
  handle.rotation = from_rpy({0.1f, 0.2f, 0.3f});
  handle.width_m = 0.05f;
  handle.gap_m = {0.01f, 0.02f};
  handle.observed_free = {0.5f, 1};
  handle.score = 0.7f;
  handle.segment = 4;
  handle.num_points = 99;
  Eigen::Isometry3f T = Eigen::Isometry3f::Identity();
  T.linear() = from_rpy({-0.5f, 0.7f, 2});
  T.translation() = Eigen::Vector3f(-1, 0.5f, 4);
  const Handle there = transformed(handle, T);
  const Eigen::Vector3f tip(0.01f, 0.02f, 0.03f);
  EXPECT_LT((there.position + there.rotation * tip - T * (handle.position + handle.rotation * tip)).norm(),
            1e-6f);
  EXPECT_EQ(there.width_m, handle.width_m);
  EXPECT_EQ(there.gap_m, handle.gap_m);
  EXPECT_EQ(there.observed_free, handle.observed_free);
  EXPECT_EQ(there.score, handle.score);
  EXPECT_EQ(there.segment, handle.segment);
  EXPECT_EQ(there.num_points, handle.num_points);
  const Handle back = transformed(there, T.inverse());
  EXPECT_LT((back.position - handle.position).norm(), 2e-6f);
  EXPECT_LT((back.rotation - handle.rotation).norm(), 2e-6f);
}

}  // namespace
}  // namespace graspd

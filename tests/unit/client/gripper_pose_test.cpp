// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/common/gripper_pose.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <utility>

#include "client/common/read_file.hpp"
#include "tests/support/temp_folder.hpp"

namespace graspd {
namespace {

/// Turned by 90 degrees about z, with a quaternion of length 2.
handle_t turned_handle() {
  handle_t handle{};
  handle.position[0] = 1;
  handle.orientation[0] = handle.orientation[3] = std::sqrt(2.0);
  return handle;
}

TEST(GripperPose, TakesTheGrippersAxesToTheFrame) {
  const Eigen::Isometry3d T = T_frame_gripper(turned_handle());
  EXPECT_TRUE((T * Eigen::Vector3d(1, 2, 3)).isApprox(Eigen::Vector3d(1 - 2, 1, 3), 1e-12));
  EXPECT_NEAR(T.linear().determinant(), 1, 1e-12);
}

TEST(GripperBoxes, StandAroundTheObject) {
  gripper_t gripper{};
  gripper.finger_width = 0.01;
  gripper.finger_thickness = 0.02;
  gripper.finger_length = 0.05;
  gripper.grasp_depth = 0.03;
  EXPECT_DOUBLE_EQ(palm_z(gripper), -0.02);
  const auto boxes = gripper_boxes(gripper, {0.06, 0.08, 0.015}, Eigen::Isometry3d::Identity());
  const auto expect_box = [](const Box& box, const Eigen::Vector3f& min, const Eigen::Vector3f& max) {
    EXPECT_TRUE(box[0].isApprox(min, 1e-6F)) << box[0].transpose();
    EXPECT_TRUE(box[7].isApprox(max, 1e-6F)) << box[7].transpose();
    EXPECT_TRUE(box[2].isApprox(Eigen::Vector3f(min.x(), max.y(), min.z()), 1e-6F)) << box[2].transpose();
  };
  expect_box(boxes[0], {-0.01F, -0.04F, -0.02F}, {0.01F, -0.03F, 0.03F});
  expect_box(boxes[1], {-0.01F, 0.03F, -0.02F}, {0.01F, 0.04F, 0.03F});
  expect_box(boxes[2], {-0.01F, -0.05F, -0.035F}, {0.01F, 0.05F, -0.02F});
  const auto elsewhere = gripper_boxes(gripper, {0.06, 0.08, 0.015}, T_frame_gripper(turned_handle()));
  EXPECT_TRUE(elsewhere[0][0].isApprox(Eigen::Vector3f(1.04F, -0.01F, -0.02F), 1e-6F));
}

TEST(ReadFile, GivesAllBytesOrSaysWhyNot) {
  const TempFolder folder;
  const std::string bytes("a\0\xff\n", 4);
  EXPECT_EQ(read_file(folder.write("f", bytes)), bytes);
  EXPECT_EQ(read_file(folder.write("empty", "")), "");
  for (const auto& [path, reason] :
       {std::pair{folder / "none", "No such file or directory"}, {folder.path(), "a folder"}}) {
    try {
      (void)read_file(path);
      FAIL() << path;
    } catch (const std::runtime_error& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with(path.string() + ": cannot be read: "))
          << error.what();
      EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace graspd

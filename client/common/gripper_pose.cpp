// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/common/gripper_pose.hpp"

namespace graspd {
namespace {

Box box(const Eigen::Vector3d& min, const Eigen::Vector3d& max, const Eigen::Isometry3d& T_frame_gripper) {
  Box corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector3d corner((i & 1) != 0 ? max.x() : min.x(), (i & 2) != 0 ? max.y() : min.y(),
                                 (i & 4) != 0 ? max.z() : min.z());
    corners[i] = (T_frame_gripper * corner).cast<float>();
  }
  return corners;
}

}  // namespace

Eigen::Isometry3d T_frame_gripper(const handle_t& handle) {
  const double* o = handle.orientation;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::Quaterniond(o[0], o[1], o[2], o[3]).normalized().toRotationMatrix();
  T.translation() = Eigen::Vector3d(handle.position);
  return T;
}

double palm_z(const gripper_t& gripper) {
  return gripper.grasp_depth - gripper.finger_length;
}

std::array<Box, 3> gripper_boxes(const gripper_t& gripper, const HandShape& shape,
                                 const Eigen::Isometry3d& T_frame_gripper) {
  const double half = shape.opening_m / 2, w = gripper.finger_width, e = gripper.finger_thickness / 2;
  const double palm = shape.palm_opening_m / 2 + w;
  const double tip = gripper.grasp_depth, root = palm_z(gripper), back = root - shape.palm_depth_m;
  return {box({-e, -half - w, root}, {e, -half, tip}, T_frame_gripper),
          box({-e, half, root}, {e, half + w, tip}, T_frame_gripper),
          box({-e, -palm, back}, {e, palm, root}, T_frame_gripper)};
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/draw/gripper_shape.hpp"

#include <algorithm>

#include "service/pipeline/handle_check.hpp"

namespace graspd {

GripperShape gripper_shape(const gripper_t& gripper, const handle_t& handle) {
  const HandleCheckConfig checked;
  const double* o = handle.orientation;
  Eigen::Isometry3d T_frame_gripper = Eigen::Isometry3d::Identity();
  T_frame_gripper.linear() = Eigen::Quaterniond(o[0], o[1], o[2], o[3]).normalized().toRotationMatrix();
  T_frame_gripper.translation() = Eigen::Vector3d(handle.position);
  const auto box = [&](const Eigen::Vector3d& min, const Eigen::Vector3d& max) {
    Box corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Eigen::Vector3d corner((i & 1) ? max.x() : min.x(), (i & 2) ? max.y() : min.y(),
                                   (i & 4) ? max.z() : min.z());
      corners[i] = (T_frame_gripper * corner).cast<float>();
    }
    return corners;
  };
  const double half_opening =
      0.5 * std::min(gripper.aperture, handle.width + 2 * double{checked.clearance_m});
  const double half_e = 0.5 * gripper.finger_thickness;
  const double outside = half_opening + gripper.finger_width;
  const double tip = gripper.grasp_depth, root = tip - gripper.finger_length;
  const double back = root - double{checked.palm_depth_m};
  GripperShape shape;
  shape.boxes = {box({-half_e, -outside, root}, {half_e, -half_opening, tip}),
                 box({-half_e, half_opening, root}, {half_e, outside, tip}),
                 box({-half_e, -outside, back}, {half_e, outside, root})};
  shape.palm = (T_frame_gripper * Eigen::Vector3d(0, 0, back)).cast<float>();
  return shape;
}

}  // namespace graspd

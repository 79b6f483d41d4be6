// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/draw/gripper_shape.hpp"

#include <algorithm>

#include "service/pipeline/handle_check.hpp"

namespace graspd {

GripperShape gripper_shape(const gripper_t& gripper, const handle_t& handle) {
  const HandleCheckConfig checked;
  const double opening = std::min(gripper.aperture, handle.width + 2 * double{checked.clearance_m});
  const double palm_depth = double{checked.palm_depth_m};
  const Eigen::Isometry3d T = T_frame_gripper(handle);
  return {gripper_boxes(gripper, {opening, opening, palm_depth}, T),
          (T * Eigen::Vector3d(0, 0, palm_z(gripper) - palm_depth)).cast<float>()};
}

}  // namespace graspd

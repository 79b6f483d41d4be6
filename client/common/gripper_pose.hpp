// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Where the gripper of a handle is, and its volumes there.
#pragma once
#include <Eigen/Geometry>
#include <array>

#include "graspd/gripper_t.hpp"
#include "graspd/handle_t.hpp"

namespace graspd {

/// Takes gripper coordinates to the frame of the list that the handle is in [m]. A quaternion that is not of
/// unit length counts as its direction.
[[nodiscard]] Eigen::Isometry3d T_frame_gripper(const handle_t& handle);

/// Corner i has bit 0, 1 and 2 of i for the far side along x, y and z of the gripper frame.
using Box = std::array<Eigen::Vector3f, 8>;

/// What a handle does not say about the hand that takes it [m].
struct HandShape {
  double opening_m = 0;       ///< between the fingers
  double palm_opening_m = 0;  ///< the palm reaches over fingers that are so far apart
  double palm_depth_m = 0;    ///< behind the fingers
};

/// The finger at -y, the one at +y and the palm, in the frame of T_frame_gripper [m].
[[nodiscard]] std::array<Box, 3> gripper_boxes(const gripper_t& gripper, const HandShape& shape,
                                               const Eigen::Isometry3d& T_frame_gripper);

/// z of the palm's front in the gripper frame, where the fingers begin [m].
[[nodiscard]] double palm_z(const gripper_t& gripper);

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The gripper at a handle, as boxes.
#pragma once
#include <Eigen/Geometry>
#include <array>

#include "client/common/gripper_pose.hpp"

namespace graspd {

struct GripperShape {
  std::array<Box, 3> boxes;  ///< two fingers and the palm, in the frame of the handle [m]
  Eigen::Vector3f palm = Eigen::Vector3f::Zero();  ///< middle of the palm's back
};

/// Opened as wide as the object needs, as the daemon checks it.
[[nodiscard]] GripperShape gripper_shape(const gripper_t& gripper, const handle_t& handle);

/// Corners of each side of a box, in turn around it.
inline constexpr std::array<std::array<std::size_t, 4>, 6> kBoxSides{
    {{0, 2, 6, 4}, {1, 5, 7, 3}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 6, 7, 5}}};
inline constexpr std::array<std::array<std::size_t, 2>, 12> kBoxEdges{
    {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// A place and pose where the gripper can hold something: the result of the method.
#pragma once
#include <Eigen/Geometry>
#include <array>

namespace graspd {

/// Gripper frame: origin between the jaws on the object's visible surface, x = major axis (across the motion
/// of the jaws), y = closing axis, z = approach (into the object); right-handed. Where the support or
/// something else keeps the fingertips from going in to the grasp depth l, the origin is as much above the
/// surface: the fingertips are always l further along z. In the frame of the cloud unless moved.
struct Handle {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();      ///< origin of the gripper frame [m]
  Eigen::Matrix3f rotation = Eigen::Matrix3f::Identity();  ///< columns: major axis, closing axis, approach
  float width_m = 0;                                       ///< extent of the object between the jaws
  std::array<float, 2> gap_m{};                            ///< free beside the object at -y and +y, at most d
  std::array<float, 2> observed_free{};  ///< share of each finger's volume seen to be free [0, 1]
  float score = 0;                       ///< how likely it holds [0, 1]
  int segment = -1;                      ///< of the surface it was found on
  int num_points = 0;                    ///< measured points between the jaws
};

/// Unit quaternion of a rotation, with w >= 0.
[[nodiscard]] Eigen::Quaternionf quaternion(const Eigen::Matrix3f& rotation);

/// Roll, pitch, yaw [rad] with R = Rz(yaw) Ry(pitch) Rx(roll); pitch in [-pi/2, pi/2] (the paper's theta_x,
/// y, z).
[[nodiscard]] Eigen::Vector3f roll_pitch_yaw(const Eigen::Matrix3f& rotation);

/// The same handle in another frame.
[[nodiscard]] Handle transformed(const Handle& handle, const Eigen::Isometry3f& T_target_source);

}  // namespace graspd

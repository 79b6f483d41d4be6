// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/handle.hpp"

#include <cmath>

namespace graspd {

Eigen::Quaternionf quaternion(const Eigen::Matrix3f& rotation) {
  Eigen::Quaternionf q(rotation);
  q.normalize();
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  return q;
}

Eigen::Vector3f roll_pitch_yaw(const Eigen::Matrix3f& r) {
  // Roll from what is left after yaw and pitch: near the gimbal lock, where yaw is ill-defined, the two still
  // fit.
  const float yaw = std::atan2(r(1, 0), r(0, 0));
  const float pitch = std::atan2(-r(2, 0), std::hypot(r(0, 0), r(1, 0)));
  const float s = std::sin(yaw), c = std::cos(yaw);
  return {std::atan2(s * r(0, 2) - c * r(1, 2), c * r(1, 1) - s * r(0, 1)), pitch, yaw};
}

Handle transformed(const Handle& handle, const Eigen::Isometry3f& T_target_source) {
  Handle moved = handle;
  moved.position = T_target_source * handle.position;
  moved.rotation = T_target_source.linear() * handle.rotation;
  return moved;
}

}  // namespace graspd

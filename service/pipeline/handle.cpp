// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/handle.hpp"

#include <algorithm>
#include <cmath>

namespace graspd {

Eigen::Quaternionf quaternion(const Eigen::Matrix3f& rotation) {
  Eigen::Quaternionf q(rotation);
  q.normalize();
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  return q;
}

Eigen::Vector3f roll_pitch_yaw(const Eigen::Matrix3f& rotation) {
  const float pitch = std::asin(std::clamp(-rotation(2, 0), -1.0f, 1.0f));
  // Looking straight along z only the sum of roll and yaw is defined; roll takes none of it.
  if (std::abs(rotation(2, 0)) > 1 - 1e-6f) return {0, pitch, std::atan2(-rotation(0, 1), rotation(1, 1))};
  return {std::atan2(rotation(2, 1), rotation(2, 2)), pitch, std::atan2(rotation(1, 0), rotation(0, 0))};
}

Handle transformed(const Handle& handle, const Eigen::Isometry3f& T_target_source) {
  Handle moved = handle;
  moved.position = T_target_source * handle.position;
  moved.rotation = T_target_source.linear() * handle.rotation;
  return moved;
}

}  // namespace graspd

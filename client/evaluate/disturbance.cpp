// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/disturbance.hpp"

#include <numbers>

namespace graspd {

std::array<Handle, kDisturbances> disturbed(const Handle& handle) {
  constexpr float kShift = 0.003f;
  constexpr float kTurn = 5 * std::numbers::pi_v<float> / 180;
  std::array<Handle, kDisturbances> result;
  result.fill(handle);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3f unit = Eigen::Vector3f::Unit(static_cast<Eigen::Index>(axis));
    for (const std::size_t both : {0, 1}) {
      const float sign = both == 0 ? -1.0f : 1.0f;
      result[4 * axis + both].position += handle.rotation * unit * sign * kShift;
      result[4 * axis + 2 + both].rotation = handle.rotation * Eigen::AngleAxisf(sign * kTurn, unit);
    }
  }
  return result;
}

int valid_disturbances(const LabelScene& scene, const Gripper& gripper, const Handle& handle, int wanted) {
  int valid = 0, left = kDisturbances;
  for (const Handle& other : disturbed(handle)) {
    if (valid >= wanted || valid + left < wanted) break;
    valid += judge(scene, gripper, other).valid() ? 1 : 0;
    --left;
  }
  return valid;
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/support_check.hpp"

#include <algorithm>
#include <array>
#include <span>

namespace graspd {
namespace {

/// The gripper with its way in at a handle.
struct Hand {
  const Gripper& gripper;
  const HandleCheckConfig& config;
  const Handle& handle;
  float half_m;  // of the opening

  [[nodiscard]] float half() const { return 0.5f * gripper.aperture_m + gripper.finger_width_m; }
  [[nodiscard]] float palm_top() const { return gripper.grasp_depth_m - gripper.finger_length_m; }
  [[nodiscard]] float farthest() const { return palm_top() - config.palm_depth_m - config.way_m; }
  [[nodiscard]] Eigen::Vector3f at(float a, float f, float z) const {
    return handle.position + handle.rotation * Eigen::Vector3f(a, f, z);
  }
};

bool is_above(const Plane& plane, const Hand& hand) {
  const float half = hand.half_m, tip = hand.gripper.grasp_depth_m;
  for (const float a : {-0.5f * hand.gripper.finger_thickness_m, 0.5f * hand.gripper.finger_thickness_m})
    for (const float side : {-1.0f, 1.0f}) {
      const auto height = [&](float f, float z) { return plane.height(hand.at(a, side * f, z)); };
      if (std::min(height(half, tip), height(half + hand.gripper.finger_width_m, tip)) <
          hand.config.support_clearance_m)
        return false;
      if (std::min(height(hand.half(), hand.palm_top()), height(hand.half(), hand.farthest())) < 0)
        return false;
    }
  return true;
}

/// Along the edges of a box and a few lines of it between them, at these places along the closing axis.
bool is_blocked(const Level& level, const Hand& hand, std::span<const float> places, float z0, float z1) {
  const float half_e = 0.5f * hand.gripper.finger_thickness_m;
  for (const float f : places) {
    for (const float a : {-half_e, half_e})
      if (level.blocks(hand.at(a, f, z0), hand.at(a, f, z1))) return true;
    for (const float z : {z0, z1})
      if (level.blocks(hand.at(-half_e, f, z), hand.at(half_e, f, z))) return true;
  }
  for (const float a : {-half_e, half_e})
    for (const float z : {z0, z1})
      if (level.blocks(hand.at(a, places.front(), z), hand.at(a, places.back(), z))) return true;
  return false;
}

bool is_blocked(const Level& level, const Hand& hand) {
  const float half = hand.half_m, outside = half + hand.gripper.finger_width_m, all = hand.half();
  const float tip = hand.gripper.grasp_depth_m;
  return is_blocked(level, hand, std::array{-outside, -half}, hand.palm_top(), tip) ||
         is_blocked(level, hand, std::array{half, outside}, hand.palm_top(), tip) ||
         is_blocked(level, hand, std::array{-all, -0.5f * all, 0.0f, 0.5f * all, all}, hand.farthest(),
                    hand.palm_top());
}

}  // namespace

bool is_clear_of_support(const SceneView& scene, const Gripper& gripper, const HandleCheckConfig& config,
                         const Handle& handle, float half_m, std::int32_t object) {
  const Plane* const own = scene.plane_under(object);
  if (own == nullptr) return true;
  const Hand hand{gripper, config, handle, half_m};
  return is_above(*own, hand) &&
         std::none_of(scene.support->levels.begin(), scene.support->levels.end(),
                      [&](const Level& level) { return &level.plane != own && is_blocked(level, hand); });
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The volumes of a gripper around a handle, in the handle's own frame: x = major axis, y = closing axis, z =
// approach, z = 0 at the handle's position.
#pragma once
#include <Eigen/Core>
#include <array>

#include "service/pipeline/gripper.hpp"
#include "service/pipeline/handle.hpp"

namespace graspd {

struct LocalBox {
  Eigen::Vector3f min = Eigen::Vector3f::Zero();
  Eigen::Vector3f max = Eigen::Vector3f::Zero();

  [[nodiscard]] bool contains(const Eigen::Vector3f& p) const {
    return (p.array() >= min.array()).all() && (p.array() <= max.array()).all();
  }
  [[nodiscard]] std::array<Eigen::Vector3f, 8> corners() const;
};

/// Jaws opened a little wider than the object, the fingertips at the grasp depth.
class GripGeometry {
 public:
  GripGeometry(const Gripper& gripper, float object_width_m);

  static constexpr float kClearance = 0.005f;  ///< on each side of the object [m]
  static constexpr float kPalmDepth = 0.020f;  ///< of the palm behind the fingers [m]
  static constexpr float kWay = 0.100f;        ///< that the hand comes from straight behind [m]

  [[nodiscard]] float half_opening() const { return half_opening_; }
  [[nodiscard]] float half_thickness() const { return half_thickness_; }
  [[nodiscard]] float tip() const { return tip_; }    ///< z of the fingertips
  [[nodiscard]] float palm() const { return palm_; }  ///< z of the palm

  [[nodiscard]] LocalBox between_jaws() const;
  [[nodiscard]] LocalBox finger(int side) const;  ///< -1: at -y, +1: at +y
  [[nodiscard]] LocalBox palm_box() const;
  /// What the palm and the fingers pass through before they are in place.
  [[nodiscard]] LocalBox palm_way() const;
  [[nodiscard]] LocalBox finger_way(int side) const;
  /// All of the above.
  [[nodiscard]] LocalBox everything() const;

 private:
  float half_opening_, half_thickness_, half_hand_, finger_width_, tip_, palm_;
};

}  // namespace graspd

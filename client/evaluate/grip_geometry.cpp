// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/grip_geometry.hpp"

#include <algorithm>

namespace graspd {

std::array<Eigen::Vector3f, 8> LocalBox::corners() const {
  std::array<Eigen::Vector3f, 8> result;
  for (std::size_t k = 0; k < result.size(); ++k)
    result[k] = {(k & 1) != 0 ? max.x() : min.x(), (k & 2) != 0 ? max.y() : min.y(),
                 (k & 4) != 0 ? max.z() : min.z()};
  return result;
}

GripGeometry::GripGeometry(const Gripper& gripper, float object_width_m)
    : half_opening_(std::min(object_width_m + 2 * kClearance, gripper.aperture_m) / 2),
      half_thickness_(gripper.finger_thickness_m / 2),
      half_hand_(gripper.aperture_m / 2 + gripper.finger_width_m),
      finger_width_(gripper.finger_width_m),
      tip_(gripper.grasp_depth_m),
      palm_(gripper.grasp_depth_m - gripper.finger_length_m) {}

LocalBox GripGeometry::between_jaws() const {
  return {{-half_thickness_, -half_opening_, palm_}, {half_thickness_, half_opening_, tip_}};
}

LocalBox GripGeometry::finger(int side) const {
  const float inner = half_opening_, outer = half_opening_ + finger_width_;
  return {{-half_thickness_, side < 0 ? -outer : inner, palm_},
          {half_thickness_, side < 0 ? -inner : outer, tip_}};
}

LocalBox GripGeometry::palm_box() const {
  return {{-half_thickness_, -half_hand_, palm_ - kPalmDepth}, {half_thickness_, half_hand_, palm_}};
}

LocalBox GripGeometry::palm_way() const {
  LocalBox box = palm_box();
  box.max.z() = box.min.z();
  box.min.z() -= kWay;
  return box;
}

LocalBox GripGeometry::finger_way(int side) const {
  LocalBox box = finger(side);
  box.max.z() = palm_;
  box.min.z() -= kWay;
  return box;
}

LocalBox GripGeometry::everything() const {
  const LocalBox way = palm_way();
  return {way.min, {half_thickness_, half_hand_, tip_}};
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What does not flicker about the visible part of one object: where its middle is, which way it is long.
#pragma once
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "service/pipeline/gripper.hpp"
#include "service/pipeline/handle_check.hpp"
#include "service/pipeline/raw_vector.hpp"
#include "service/pipeline/surfaces.hpp"

namespace graspd {

class ObjectShape {
 public:
  /// points: the object's voxels, at least one; object: its number in the guess that they come from. All must
  /// outlive the shape.
  ObjectShape(const Surfaces& surfaces, std::span<const std::uint32_t> points, std::int32_t object,
              const Eigen::Vector3f& center);

  [[nodiscard]] const Eigen::Vector3f& center() const { return center_; }  ///< mean of the voxels
  /// Unit direction from the sensor to the center.
  [[nodiscard]] const Eigen::Vector3f& sight() const { return sight_; }

  /// Coordinate along a unit axis, from the frame's origin, half-way between the object's ends: unlike a mean
  /// it does not depend on how many points are measured where [m].
  [[nodiscard]] float middle(const Eigen::Vector3f& axis) const;

  /// The place on top of its middle for a gripper with these axes; nothing where the jaws do not get around
  /// it.
  [[nodiscard]] std::optional<Candidate> middle_place(const Eigen::Matrix3f& rotation,
                                                      const Gripper& gripper) const;

  /// Unit vector, of either sign; nothing when the object is about as wide as it is long.
  [[nodiscard]] std::optional<Eigen::Vector3f> long_axis() const;

 private:
  /// Coordinates of the points.
  [[nodiscard]] RawVector<float> along(const Eigen::Vector3f& axis) const;

  const Surfaces& surfaces_;
  std::span<const std::uint32_t> indices_;  // of the voxels
  PointCloud points_;                       // the same
  std::int32_t object_;
  Eigen::Vector3f center_, sight_;
};

}  // namespace graspd

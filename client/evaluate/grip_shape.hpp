// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The shape of an object between the jaws: which way its sides run, and what a jaw would touch.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "client/evaluate/grip_geometry.hpp"

namespace graspd {

/// What a judge sees of one object around a handle, in the handle's frame.
struct GripShape {
  GripGeometry geometry;
  std::vector<Eigen::Vector3f> between;  ///< points of the object between the jaws
  std::vector<Eigen::Vector3f> around;   ///< the same and a margin around them, for normals
  Eigen::Vector3f viewpoint = Eigen::Vector3f::Zero();
  float point_area_m2 = 0;  ///< across the line of sight that a point stands for
};

/// Margin of GripShape::around [m].
inline constexpr float kShapeMargin = 0.010f;

/// The object is in the middle of the fingers, and its silhouettes run so much along the major axis that the
/// jaws do not slip.
[[nodiscard]] bool sides_hold(const GripShape& shape);

/// Towards the fingertips the object does not widen so much that the jaws slide off.
[[nodiscard]] bool walls_hold(const GripShape& shape);

/// Where the object ends towards one jaw.
struct JawContact {
  Eigen::Vector3f end = Eigen::Vector3f::Zero();  ///< middle of the strip of points that is the end
  bool wall_seen = false;                         ///< what is seen there faces the jaw
  bool towards_viewpoint = false;                 ///< a wall there would be seen
  bool sloping = false;                           ///< the face there slopes towards the jaw
  bool turning = false;                           ///< the face turns towards the jaw, as round ones do
  bool carried_on_clear = false;  ///< the face, carried on out of sight, stays clear of the finger
  /// A flat slope, off which the jaw slides.
  [[nodiscard]] bool is_wedge() const { return sloping && !turning; }
  std::vector<Eigen::Vector3f> border;  ///< points of the end
};

/// side: -1 at -y, +1 at +y. The shape must have points between the jaws.
[[nodiscard]] JawContact find_contact(const GripShape& shape, int side);

/// Seen surface between the jaws [m2].
[[nodiscard]] float seen_area(const GripShape& shape);

/// z of the object's top between the jaws [m].
[[nodiscard]] float top_of(const GripShape& shape);

}  // namespace graspd

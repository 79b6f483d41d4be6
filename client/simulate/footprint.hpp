// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What an object covers, seen from above: for placing objects without one going through another.
#pragma once
#include <Eigen/Core>

namespace graspd {

/// A prism over a rectangle with rounded corners: all points within radius of the rectangle, between two
/// heights. A circle is a rectangle without size.
struct Footprint {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  Eigen::Vector2d half = Eigen::Vector2d::Zero();  ///< of the rectangle, along its own axes [m]
  double yaw_rad = 0;
  double radius = 0;  ///< [m]
  double z_min = 0;
  double z_max = 0;

  /// Of the smallest circle around its centre [m].
  [[nodiscard]] double reach() const { return half.norm() + radius; }
};

/// Moved within the plane and turned about the origin first.
[[nodiscard]] Footprint moved(const Footprint& footprint, const Eigen::Vector2d& by, double yaw_rad,
                              double up);

/// The free distance between two, seen from above [m]; 0 or less when they overlap.
[[nodiscard]] double clearance(const Footprint& a, const Footprint& b);

/// Whether they are closer than gap on every height that both have.
[[nodiscard]] bool collide(const Footprint& a, const Footprint& b, double gap);

}  // namespace graspd

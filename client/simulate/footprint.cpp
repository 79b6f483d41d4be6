// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/simulate/footprint.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

namespace graspd {
namespace {

using Eigen::Vector2d;

Vector2d to_local(const Footprint& f, const Vector2d& p) {
  return Eigen::Rotation2Dd(-f.yaw_rad) * (p - f.center);
}

std::array<Vector2d, 4> corners(const Footprint& f) {
  const Eigen::Rotation2Dd turn(f.yaw_rad);
  const auto at = [&](double x, double y) -> Vector2d {
    return f.center + turn * Vector2d(x * f.half.x(), y * f.half.y());
  };
  return {at(-1, -1), at(1, -1), at(1, 1), at(-1, 1)};
}

/// Of b's rectangle beyond a's along the axes of a; positive on an axis that separates them.
double separation(const Footprint& a, const Footprint& b) {
  Eigen::Array2d low = Eigen::Array2d::Constant(1e9);
  Eigen::Array2d high = Eigen::Array2d::Constant(-1e9);
  for (const Vector2d& corner : corners(b)) {
    const Eigen::Array2d p = to_local(a, corner).array();
    low = low.min(p);
    high = high.max(p);
  }
  return std::max((low - a.half.array()).maxCoeff(), (-a.half.array() - high).maxCoeff());
}

/// From the corners of b to the rectangle of a.
double nearest_corner(const Footprint& a, const Footprint& b) {
  double nearest = 1e9;
  for (const Vector2d& corner : corners(b)) {
    nearest = std::min(nearest, (to_local(a, corner).cwiseAbs() - a.half).cwiseMax(0).norm());
  }
  return nearest;
}

}  // namespace

Footprint moved(const Footprint& footprint, const Vector2d& by, double yaw_rad, double up) {
  Footprint f = footprint;
  f.center = by + Eigen::Rotation2Dd(yaw_rad) * footprint.center;
  f.yaw_rad += yaw_rad;
  f.z_min += up;
  f.z_max += up;
  return f;
}

double clearance(const Footprint& a, const Footprint& b) {
  // Two convex polygons that do not overlap are nearest at a corner of one of them.
  const bool apart = std::max(separation(a, b), separation(b, a)) > 0;
  const double rectangles = apart ? std::min(nearest_corner(a, b), nearest_corner(b, a)) : 0;
  return rectangles - a.radius - b.radius;
}

bool collide(const Footprint& a, const Footprint& b, double gap) {
  if (a.z_min >= b.z_max || b.z_min >= a.z_max) return false;
  if ((a.center - b.center).norm() > a.reach() + b.reach() + gap) return false;
  // Overlapping rectangles without rounding have a clearance of 0.
  const double free = clearance(a, b);
  return free <= 0 || free < gap;
}

}  // namespace graspd

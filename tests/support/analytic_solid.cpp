// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/analytic_solid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace graspd {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Narrows the chord to -half <= o + t d <= half.
void clip_slab(double o, double d, double half, Chord& chord) {
  if (d == 0) {
    if (std::abs(o) > half) chord = {kInfinity, -kInfinity};
    return;
  }
  const double t0 = (-half - o) / d, t1 = (half - o) / d;
  chord.enter = std::max(chord.enter, std::min(t0, t1));
  chord.leave = std::min(chord.leave, std::max(t0, t1));
}

/// Narrows the chord to |o + t d| <= radius.
template <class Vector>
void clip_round(const Vector& o, const Vector& d, double radius, Chord& chord) {
  const double a = d.squaredNorm(), b = o.dot(d), c = o.squaredNorm() - radius * radius;
  if (a == 0) {
    if (c > 0) chord = {kInfinity, -kInfinity};
    return;
  }
  const double discriminant = b * b - a * c;
  if (discriminant < 0) {
    chord = {kInfinity, -kInfinity};
    return;
  }
  chord.enter = std::max(chord.enter, (-b - std::sqrt(discriminant)) / a);
  chord.leave = std::min(chord.leave, (-b + std::sqrt(discriminant)) / a);
}

void clip_below(double o, double d, Chord& chord) {
  if (d == 0) {
    if (o > 0) chord = {kInfinity, -kInfinity};
  } else if (d < 0) {
    chord.enter = std::max(chord.enter, -o / d);
  } else {
    chord.leave = std::min(chord.leave, -o / d);
  }
}

}  // namespace

std::optional<Chord> intersect(const AnalyticSolid& solid, const Eigen::Vector3d& origin,
                               const Eigen::Vector3d& direction) {
  const Eigen::Vector3d o = solid.T_scene_solid.inverse() * origin;
  const Eigen::Vector3d d = solid.T_scene_solid.linear().transpose() * direction;
  Chord chord{-kInfinity, kInfinity};
  switch (solid.shape) {
    case SolidShape::kBox:
      for (int axis = 0; axis < 3; ++axis) clip_slab(o[axis], d[axis], solid.half[axis], chord);
      break;
    case SolidShape::kCylinder:
      clip_slab(o.z(), d.z(), solid.half.z(), chord);
      clip_round(Eigen::Vector2d(o.head<2>()), Eigen::Vector2d(d.head<2>()), solid.half.x(), chord);
      break;
    case SolidShape::kSphere:
      clip_round(o, d, solid.half.x(), chord);
      break;
    case SolidShape::kHalfSpace:
      clip_below(o.z(), d.z(), chord);
      break;
  }
  if (chord.enter > chord.leave) return std::nullopt;
  return chord;
}

double signed_distance(const AnalyticSolid& solid, const Eigen::Vector3d& point) {
  const Eigen::Vector3d p = solid.T_scene_solid.inverse() * point;
  switch (solid.shape) {
    case SolidShape::kBox: {
      const Eigen::Vector3d q = p.cwiseAbs() - solid.half;
      return q.cwiseMax(0).norm() + std::min(0.0, q.maxCoeff());
    }
    case SolidShape::kCylinder: {
      const Eigen::Vector2d q(p.head<2>().norm() - solid.half.x(), std::abs(p.z()) - solid.half.z());
      return q.cwiseMax(0).norm() + std::min(0.0, q.maxCoeff());
    }
    case SolidShape::kSphere:
      return p.norm() - solid.half.x();
    case SolidShape::kHalfSpace:
      break;
  }
  return p.z();
}

}  // namespace graspd

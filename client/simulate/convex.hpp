// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Convex bodies and what a ray meets of them: the parts that solids are made of.
#pragma once
#include <Eigen/Geometry>
#include <optional>
#include <variant>

namespace graspd {

/// Points origin + t * direction; direction of any length but zero.
struct Ray {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();

  [[nodiscard]] Eigen::Vector3d at(double t) const { return origin + t * direction; }
};

/// Where a ray crosses a surface; the normal points out of the body and has unit length.
struct Crossing {
  double t = 0;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
};

/// The part of a line that is inside a convex body; t may be negative.
struct Interval {
  Crossing enter, leave;
};

/// Axis-aligned box; lengths in metres here and below.
struct Box {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Vector3d half = Eigen::Vector3d::Ones();
};

/// Around the z axis, with flat ends.
struct Cylinder {
  double radius = 1;
  double z_min = 0;
  double z_max = 1;
};

struct Ball {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 1;
};

/// A ball around the origin between two planes across z, |z_min| and |z_max| at most radius.
struct BallSlice {
  double radius = 1;
  double z_min = -1;
  double z_max = 0;
};

/// All points within radius of the line from a to b.
struct Capsule {
  Eigen::Vector3d a = Eigen::Vector3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::UnitZ();
  double radius = 1;
};

using Convex = std::variant<Box, Cylinder, Ball, BallSlice, Capsule>;

/// Exact; nothing where the line misses the body or only touches it.
[[nodiscard]] std::optional<Interval> intersect(const Convex& body, const Ray& ray);

/// Negative inside. The sign is exact; the amount is never more than the true distance to the surface, and
/// equal to it for all but ball slices.
[[nodiscard]] double signed_distance(const Convex& body, const Eigen::Vector3d& point);

/// The smallest axis-aligned box around it, or a little more.
[[nodiscard]] Eigen::AlignedBox3d bounds(const Convex& body);

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/simulate/convex.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace graspd {
namespace {

using Eigen::Vector3d;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Interval whole_line() {
  return {{-kInfinity, Vector3d::Zero()}, {kInfinity, Vector3d::Zero()}};
}

/// Cuts the interval to low <= coordinate <= high; false when nothing is left.
bool clip_to_slab(Interval& interval, const Ray& ray, int axis, double low, double high) {
  const double origin = ray.origin[axis];
  const double direction = ray.direction[axis];
  if (direction == 0) return origin > low && origin < high;
  const double sign = direction > 0 ? 1 : -1;
  const double t_enter = ((direction > 0 ? low : high) - origin) / direction;
  const double t_leave = ((direction > 0 ? high : low) - origin) / direction;
  if (t_enter > interval.enter.t) interval.enter = {t_enter, -sign * Vector3d::Unit(axis)};
  if (t_leave < interval.leave.t) interval.leave = {t_leave, sign * Vector3d::Unit(axis)};
  return interval.enter.t < interval.leave.t;
}

struct Roots {
  double low, high;
};

/// Of a t^2 + 2 b t + c = 0 with a > 0, when there are two.
std::optional<Roots> solve(double a, double half_b, double c) {
  const double discriminant = half_b * half_b - a * c;
  if (discriminant <= 0) return std::nullopt;
  // The form that does not cancel.
  const double q = -(half_b + std::copysign(std::sqrt(discriminant), half_b));
  const double t0 = q / a;
  const double t1 = q != 0 ? c / q : 0;
  return Roots{std::min(t0, t1), std::max(t0, t1)};
}

std::optional<Interval> intersect_ball(const Vector3d& center, double radius, const Ray& ray) {
  const Vector3d o = ray.origin - center;
  const auto roots =
      solve(ray.direction.squaredNorm(), o.dot(ray.direction), o.squaredNorm() - radius * radius);
  if (!roots) return std::nullopt;
  const auto crossing = [&](double t) { return Crossing{t, (o + t * ray.direction) / radius}; };
  return Interval{crossing(roots->low), crossing(roots->high)};
}

/// The same as clip_to_slab for each axis, but the normals come last: most rays meet a box or two, and large
/// ones.
std::optional<Interval> intersect_one(const Box& box, const Ray& ray) {
  double enter = -kInfinity;
  double leave = kInfinity;
  int enter_axis = 0;
  int leave_axis = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double origin = ray.origin[axis] - box.center[axis];
    const double direction = ray.direction[axis];
    if (direction == 0) {
      if (std::abs(origin) >= box.half[axis]) return std::nullopt;
      continue;
    }
    const double inverse = 1 / direction;
    const double middle = -origin * inverse;
    const double reach = box.half[axis] * std::abs(inverse);
    if (middle - reach > enter) {
      enter = middle - reach;
      enter_axis = axis;
    }
    if (middle + reach < leave) {
      leave = middle + reach;
      leave_axis = axis;
    }
  }
  if (enter >= leave) return std::nullopt;
  Interval interval{{enter, Vector3d::Zero()}, {leave, Vector3d::Zero()}};
  interval.enter.normal[enter_axis] = ray.direction[enter_axis] > 0 ? -1 : 1;
  interval.leave.normal[leave_axis] = ray.direction[leave_axis] > 0 ? 1 : -1;
  return interval;
}

std::optional<Interval> intersect_one(const Cylinder& cylinder, const Ray& ray) {
  const Eigen::Vector2d o = ray.origin.head<2>();
  const Eigen::Vector2d d = ray.direction.head<2>();
  const double c = o.squaredNorm() - cylinder.radius * cylinder.radius;
  Interval interval = whole_line();
  if (d.isZero(0)) {
    if (c >= 0) return std::nullopt;
  } else {
    const auto roots = solve(d.squaredNorm(), o.dot(d), c);
    if (!roots) return std::nullopt;
    const auto crossing = [&](double t) {
      Vector3d normal = Vector3d::Zero();
      normal.head<2>() = (o + t * d) / cylinder.radius;
      return Crossing{t, normal};
    };
    interval = {crossing(roots->low), crossing(roots->high)};
  }
  if (!clip_to_slab(interval, ray, 2, cylinder.z_min, cylinder.z_max)) return std::nullopt;
  return interval;
}

std::optional<Interval> intersect_one(const Ball& ball, const Ray& ray) {
  return intersect_ball(ball.center, ball.radius, ray);
}

std::optional<Interval> intersect_one(const BallSlice& slice, const Ray& ray) {
  auto interval = intersect_ball(Vector3d::Zero(), slice.radius, ray);
  if (interval && !clip_to_slab(*interval, ray, 2, slice.z_min, slice.z_max)) return std::nullopt;
  return interval;
}

void unite(std::optional<Interval>& sum, const std::optional<Interval>& part) {
  if (!part) return;
  if (!sum) {
    sum = part;
    return;
  }
  if (part->enter.t < sum->enter.t) sum->enter = part->enter;
  if (part->leave.t > sum->leave.t) sum->leave = part->leave;
}

/// The round wall of a capsule without its ends.
std::optional<Interval> intersect_shaft(const Capsule& capsule, const Ray& ray) {
  const Vector3d axis = capsule.b - capsule.a;
  const double length = axis.norm();
  if (length == 0) return std::nullopt;
  const Vector3d z = axis / length;
  const Vector3d from_a = ray.origin - capsule.a;
  const double height = from_a.dot(z);
  const double climb = ray.direction.dot(z);
  const Vector3d o = from_a - height * z;
  const Vector3d d = ray.direction - climb * z;
  const double a = d.squaredNorm();
  if (a == 0) return std::nullopt;  // Along the axis the end balls say it all.
  const auto roots = solve(a, o.dot(d), o.squaredNorm() - capsule.radius * capsule.radius);
  if (!roots) return std::nullopt;
  const auto crossing = [&](double t) { return Crossing{t, (o + t * d) / capsule.radius}; };
  Interval interval{crossing(roots->low), crossing(roots->high)};
  // The flat ends of the shaft lie inside the end balls: their normals are never seen.
  const Ray along{{0, 0, height}, {0, 0, climb}};
  if (!clip_to_slab(interval, along, 2, 0, length)) return std::nullopt;
  return interval;
}

std::optional<Interval> intersect_one(const Capsule& capsule, const Ray& ray) {
  auto interval = intersect_shaft(capsule, ray);
  unite(interval, intersect_ball(capsule.a, capsule.radius, ray));
  unite(interval, intersect_ball(capsule.b, capsule.radius, ray));
  return interval;
}

/// Of a product of two shapes from the signed distances to each.
double distance_to_product(double a, double b) {
  return std::hypot(std::max(a, 0.0), std::max(b, 0.0)) + std::min(std::max(a, b), 0.0);
}

double distance_to_slab(double z, double low, double high) {
  return std::max(low - z, z - high);
}

double distance_to(const Box& box, const Vector3d& point) {
  const Vector3d excess = (point - box.center).cwiseAbs() - box.half;
  return excess.cwiseMax(0).norm() + std::min(excess.maxCoeff(), 0.0);
}

double distance_to(const Cylinder& cylinder, const Vector3d& point) {
  return distance_to_product(point.head<2>().norm() - cylinder.radius,
                             distance_to_slab(point.z(), cylinder.z_min, cylinder.z_max));
}

double distance_to(const Ball& ball, const Vector3d& point) {
  return (point - ball.center).norm() - ball.radius;
}

double distance_to(const BallSlice& slice, const Vector3d& point) {
  return std::max(point.norm() - slice.radius, distance_to_slab(point.z(), slice.z_min, slice.z_max));
}

double distance_to(const Capsule& capsule, const Vector3d& point) {
  const Vector3d axis = capsule.b - capsule.a;
  const double squared = axis.squaredNorm();
  const double s = squared > 0 ? std::clamp((point - capsule.a).dot(axis) / squared, 0.0, 1.0) : 0;
  return (point - capsule.a - s * axis).norm() - capsule.radius;
}

Eigen::AlignedBox3d bounds_of(const Box& box) {
  return {box.center - box.half, box.center + box.half};
}
Eigen::AlignedBox3d bounds_of(const Cylinder& c) {
  return {Vector3d(-c.radius, -c.radius, c.z_min), Vector3d(c.radius, c.radius, c.z_max)};
}
Eigen::AlignedBox3d bounds_of(const Ball& ball) {
  return {ball.center - Vector3d::Constant(ball.radius), ball.center + Vector3d::Constant(ball.radius)};
}
Eigen::AlignedBox3d bounds_of(const BallSlice& s) {
  return {Vector3d(-s.radius, -s.radius, s.z_min), Vector3d(s.radius, s.radius, s.z_max)};
}
Eigen::AlignedBox3d bounds_of(const Capsule& c) {
  const Vector3d margin = Vector3d::Constant(c.radius);
  return {c.a.cwiseMin(c.b) - margin, c.a.cwiseMax(c.b) + margin};
}

}  // namespace

std::optional<Interval> intersect(const Convex& body, const Ray& ray) {
  return std::visit([&](const auto& shape) { return intersect_one(shape, ray); }, body);
}

double signed_distance(const Convex& body, const Vector3d& point) {
  return std::visit([&](const auto& shape) { return distance_to(shape, point); }, body);
}

Eigen::AlignedBox3d bounds(const Convex& body) {
  return std::visit([](const auto& shape) { return bounds_of(shape); }, body);
}

}  // namespace graspd

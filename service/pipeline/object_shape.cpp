// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/object_shape.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "service/pipeline/cell_order.hpp"
#include "service/pipeline/nth_value.hpp"

namespace graspd {
namespace {

/// Half-way between the ends of what is there, but for strays.
float middle_of(RawVector<float> places) {
  constexpr float kStray = 0.03f;  // share of the points that may lie beyond either end
  const auto skip = static_cast<std::size_t>(kStray * static_cast<float>(places.size()));
  const float low = nth_value(std::span<float>(places), skip);
  return 0.5f * (low + nth_value(std::span<float>(places), skip, std::greater<>()));
}

}  // namespace

ObjectShape::ObjectShape(const Surfaces& surfaces, std::span<const std::uint32_t> points, std::int32_t object,
                         const Eigen::Vector3f& center)
    : surfaces_(surfaces),
      indices_(points),
      points_(points_at(surfaces.cloud, points)),
      object_(object),
      center_(center),
      sight_((center - surfaces.cloud.viewpoint).normalized()) {}

RawVector<float> ObjectShape::along(const Eigen::Vector3f& axis) const {
  const float ax = axis.x(), ay = axis.y(), az = axis.z();
  const float *x = points_.x.data(), *y = points_.y.data(), *z = points_.z.data();
  RawVector<float> places(points_.size());
  float* place = places.data();
  // Summed as Eigen's dot() does it.
  for (std::size_t k = 0; k < places.size(); ++k) place[k] = ax * x[k] + (ay * y[k] + az * z[k]);
  return places;
}

float ObjectShape::middle(const Eigen::Vector3f& axis) const {
  return middle_of(along(axis));
}

std::optional<Candidate> ObjectShape::middle_place(const Eigen::Matrix3f& rotation,
                                                   const Gripper& gripper) const {
  constexpr float kLeeway = 0.010f;  // voxels of the sides may be a little off [m]
  constexpr float kNear = 0.010f;    // of the middle, where the top is looked for [m]
  constexpr float kFar = std::numeric_limits<float>::infinity();
  const RawVector<float> places = along(rotation.col(0));
  const float x = middle_of(places);
  std::pmr::vector<std::size_t> band;
  float low = kFar, high = -kFar;
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (std::abs(places[k] - x) > 0.5f * gripper.finger_thickness_m) continue;
    const float y = rotation.col(1).dot(points_.point(k));
    low = std::min(low, y);
    high = std::max(high, y);
    band.push_back(k);
  }
  if (band.empty() || high - low > gripper.aperture_m + kLeeway) return std::nullopt;
  const float y = 0.5f * (low + high);
  float top = kFar;
  Candidate place{{}, rotation, -1, object_};
  for (const std::size_t k : band) {
    const Eigen::Vector3f p = points_.point(k);
    const float z = rotation.col(2).dot(p);
    const std::int32_t segment = surfaces_.segments.of_point[indices_[k]];
    if (z >= top || segment < 0 || std::abs(rotation.col(1).dot(p) - y) > kNear) continue;
    top = z;
    place.segment = segment;
  }
  if (place.segment < 0) return std::nullopt;
  place.position = rotation * Eigen::Vector3f(x, y, top);
  return place;
}

std::optional<Eigen::Vector3f> ObjectShape::long_axis() const {
  constexpr float kLonger = 1.5f;  // variance along the axis against that across it
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const Eigen::Vector3d d = (points_.point(k) - center_).cast<double>();
    covariance += d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  if (solver.eigenvalues()(2) < kLonger * solver.eigenvalues()(1)) return std::nullopt;
  return solver.eigenvectors().col(2).cast<float>();
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/object_shape.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "service/pipeline/nth_value.hpp"

namespace graspd {

ObjectShape::ObjectShape(const Surfaces& surfaces, std::span<const std::uint32_t> points, std::int32_t object,
                         const Eigen::Vector3f& center)
    : surfaces_(surfaces),
      points_(points),
      object_(object),
      center_(center),
      sight_((center - surfaces.cloud.viewpoint).normalized()) {}

float ObjectShape::middle(const Eigen::Vector3f& axis) const {
  constexpr float kStray = 0.03f;  // share of the points that may lie beyond either end
  std::pmr::vector<float> along;
  along.reserve(points_.size());
  for (const std::uint32_t i : points_) along.push_back(axis.dot(surfaces_.cloud.point(i)));
  const auto skip = static_cast<std::size_t>(kStray * static_cast<float>(along.size()));
  const float low = nth_value(std::span<float>(along), skip);
  return 0.5f * (low + nth_value(std::span<float>(along), skip, std::greater<>()));
}

std::optional<Candidate> ObjectShape::middle_place(const Eigen::Matrix3f& rotation,
                                                   const Gripper& gripper) const {
  constexpr float kLeeway = 0.010f;  // voxels of the sides may be a little off [m]
  constexpr float kNear = 0.010f;    // of the middle, where the top is looked for [m]
  constexpr float kFar = std::numeric_limits<float>::infinity();
  const float x = middle(rotation.col(0));
  std::pmr::vector<std::uint32_t> band;
  float low = kFar, high = -kFar;
  for (const std::uint32_t i : points_) {
    const Eigen::Vector3f p = surfaces_.cloud.point(i);
    if (std::abs(rotation.col(0).dot(p) - x) > 0.5f * gripper.finger_thickness_m) continue;
    low = std::min(low, rotation.col(1).dot(p));
    high = std::max(high, rotation.col(1).dot(p));
    band.push_back(i);
  }
  if (band.empty() || high - low > gripper.aperture_m + kLeeway) return std::nullopt;
  const float y = 0.5f * (low + high);
  float top = kFar;
  Candidate place{{}, rotation, -1, object_};
  for (const std::uint32_t i : band) {
    const Eigen::Vector3f p = surfaces_.cloud.point(i);
    const float z = rotation.col(2).dot(p);
    if (z >= top || surfaces_.segments.of_point[i] < 0 || std::abs(rotation.col(1).dot(p) - y) > kNear)
      continue;
    top = z;
    place.segment = surfaces_.segments.of_point[i];
  }
  if (place.segment < 0) return std::nullopt;
  place.position = rotation * Eigen::Vector3f(x, y, top);
  return place;
}

std::optional<Eigen::Vector3f> ObjectShape::long_axis() const {
  constexpr float kLonger = 1.5f;  // variance along the axis against that across it
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const std::uint32_t i : points_) {
    const Eigen::Vector3d d = (surfaces_.cloud.point(i) - center_).cast<double>();
    covariance += d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  if (solver.eigenvalues()(2) < kLonger * solver.eigenvalues()(1)) return std::nullopt;
  return solver.eigenvectors().col(2).cast<float>();
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/profile_fit.hpp"

#include <Eigen/Dense>
#include <cmath>

namespace graspd {

std::vector<Eigen::Vector3f> neighbors(const std::vector<Eigen::Vector3f>& points, const Eigen::Vector3f& p,
                                       float radius_m) {
  std::vector<Eigen::Vector3f> near;
  for (const Eigen::Vector3f& q : points)
    if ((q - p).squaredNorm() <= radius_m * radius_m) near.push_back(q);
  return near;
}

std::optional<Eigen::Vector3f> plane_normal(const std::vector<Eigen::Vector3f>& points,
                                            const Eigen::Vector3f& viewpoint) {
  if (points.size() < 6) return std::nullopt;
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();
  for (const Eigen::Vector3f& p : points) mean += p / static_cast<float>(points.size());
  Eigen::Matrix3f scatter = Eigen::Matrix3f::Zero();
  for (const Eigen::Vector3f& p : points) scatter += (p - mean) * (p - mean).transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
  solver.computeDirect(scatter);
  const Eigen::Vector3f normal = solver.eigenvectors().col(0);
  return normal.dot(viewpoint - mean) < 0 ? Eigen::Vector3f(-normal) : normal;
}

std::optional<Circle> fit_circle(const std::vector<Eigen::Vector3f>& points) {
  constexpr float kMinRadius = 0.008f, kMaxRadius = 0.080f, kMaxScatter = 0.0025f;
  if (points.size() < 15) return std::nullopt;
  // |q|^2 = 2 c . q + (r^2 - |c|^2) is linear in c and the bracket.
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3f& p : points) {
    const Eigen::Vector3d row(double{p.y()}, double{p.z()}, 1);
    normal += row * row.transpose();
    right += row * (row.x() * row.x() + row.y() * row.y());
  }
  const Eigen::Vector3d x = normal.ldlt().solve(right);
  const double square = x.z() + 0.25 * (x.x() * x.x() + x.y() * x.y());
  if (!x.allFinite() || !(square > 0)) return std::nullopt;
  const Circle circle{static_cast<float>(x.x() / 2), static_cast<float>(x.y() / 2),
                      static_cast<float>(std::sqrt(square))};
  if (circle.radius < kMinRadius || circle.radius > kMaxRadius) return std::nullopt;
  float squares = 0, mean_z = 0;
  for (const Eigen::Vector3f& p : points) {
    const float off = std::hypot(p.y() - circle.y, p.z() - circle.z) - circle.radius;
    squares += off * off;
    mean_z += p.z() / static_cast<float>(points.size());
  }
  const bool scattered = squares > kMaxScatter * kMaxScatter * static_cast<float>(points.size());
  if (scattered || mean_z > circle.z) return std::nullopt;
  return circle;
}

}  // namespace graspd

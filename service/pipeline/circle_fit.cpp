// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/circle_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace graspd {
namespace {

constexpr std::size_t kMinPoints = 12;
constexpr std::size_t kMostPoints = 160;  // a spread sample says the same
constexpr float kScale = 0.002f;          // of the weights [m]
constexpr float kNear = 0.0035f;          // a point that belongs to the circle [m]
constexpr float kMinNearShare = 0.85f;
constexpr int kSectors = 36;
constexpr int kMinSectors = 6;

/// Weighted algebraic fit: x^2 + y^2 = 2 cx x + 2 cy y + c, about the mean to keep the numbers small.
Circle algebraic_fit(const std::vector<Eigen::Vector2f>& points, const std::vector<float>& weights,
                     const Eigen::Vector2f& mean) {
  Eigen::Matrix3d A = Eigen::Matrix3d::Identity() * 1e-12;
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d p = (points[i] - mean).cast<double>();
    const Eigen::Vector3d row(2 * p.x(), 2 * p.y(), 1);
    A += weights[i] * row * row.transpose();
    b += weights[i] * p.squaredNorm() * row;
  }
  const Eigen::Vector3d c = A.ldlt().solve(b);
  const double radius = std::sqrt(std::max(0.0, c[2] + c.head<2>().squaredNorm()));
  return {mean + c.head<2>().cast<float>(), static_cast<float>(radius)};
}

float distance(const Circle& circle, const Eigen::Vector2f& p) {
  return std::abs((p - circle.center).norm() - circle.radius);
}

bool describes(const Circle& circle, const std::vector<Eigen::Vector2f>& points) {
  std::size_t near = 0;
  std::uint64_t sectors = 0;
  for (const Eigen::Vector2f& p : points) {
    if (distance(circle, p) > kNear) continue;
    ++near;
    const Eigen::Vector2f d = p - circle.center;
    const float turn = std::atan2(d.y(), d.x()) / (2 * std::numbers::pi_v<float>)+0.5f;
    sectors |= std::uint64_t{1} << std::min(kSectors - 1, static_cast<int>(turn * kSectors));
  }
  return static_cast<float>(near) >= kMinNearShare * static_cast<float>(points.size()) &&
         std::popcount(sectors) >= kMinSectors;
}

}  // namespace

std::optional<Circle> fit_circle(std::span<const Eigen::Vector2f> points, float max_radius_m) {
  if (points.size() < kMinPoints) return std::nullopt;
  std::vector<Eigen::Vector2f> sample;
  const std::size_t step = (points.size() + kMostPoints - 1) / kMostPoints;
  Eigen::Vector2f mean = Eigen::Vector2f::Zero();
  for (std::size_t i = 0; i < points.size(); i += step) {
    sample.push_back(points[i]);
    mean += points[i];
  }
  mean /= static_cast<float>(sample.size());
  std::vector<float> weights(sample.size(), 1.0f);
  Circle circle;
  for (int round = 0; round < 4; ++round) {
    circle = algebraic_fit(sample, weights, mean);
    if (!(circle.radius <= max_radius_m)) return std::nullopt;
    for (std::size_t i = 0; i < sample.size(); ++i) {
      const float e = distance(circle, sample[i]) / kScale;
      weights[i] = 1 / (1 + e * e);
    }
  }
  if (!describes(circle, sample)) return std::nullopt;
  return circle;
}

}  // namespace graspd

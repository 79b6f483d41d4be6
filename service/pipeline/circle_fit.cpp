// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/circle_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "service/pipeline/point_kernels.hpp"

namespace graspd {
namespace {

constexpr std::size_t kMinPoints = 12;
constexpr std::size_t kMostPoints = 160;
constexpr float kScale = 0.002f;  // of the weights [m]
constexpr float kMinNearShare = 0.85f;
constexpr int kSectors = 36;
constexpr int kMinSectors = 6;

/// Points about their mean, which keeps the numbers small.
class Sample {
 public:
  Sample(std::span<const Eigen::Vector2f> points, std::size_t step) {
    for (std::size_t i = 0; i < points.size(); i += step) mean_ += points[i];
    size_ = (points.size() + step - 1) / step;
    mean_ /= static_cast<float>(size_);
    for (std::size_t k = 0; k < size_; ++k) {
      x_[k] = points[k * step].x() - mean_.x();
      y_[k] = points[k * step].y() - mean_.y();
    }
  }

  /// Algebraic fit: x^2 + y^2 = 2 cx x + 2 cy y + c.
  [[nodiscard]] Circle fit(const CircleWeights& weights) const {
    const CircleSums s = point_kernels().sum_circle(weights, x_.data(), y_.data(), size_);
    constexpr double kRegular = 1e-12;
    Eigen::Matrix3d A;
    A << 4 * s.xx + kRegular, 4 * s.xy, 2 * s.x, 4 * s.xy, 4 * s.yy + kRegular, 2 * s.y, 2 * s.x, 2 * s.y,
        s.n + kRegular;
    const Eigen::Vector3d c = A.ldlt().solve(Eigen::Vector3d(2 * s.qx, 2 * s.qy, s.q));
    const double radius = std::sqrt(std::max(0.0, c[2] + c.head<2>().squaredNorm()));
    return {c.head<2>().cast<float>(), static_cast<float>(radius)};
  }

  /// Whether most points, within the tolerance, belong to the circle, and to more than a small part of it.
  [[nodiscard]] bool is_described_by(const Circle& circle, float tolerance_m) const {
    std::array<std::uint8_t, kMostPoints> is_near;
    std::size_t num_near = 0;
    for (std::size_t k = 0; k < size_; ++k) {
      const float x = x_[k] - circle.center.x(), y = y_[k] - circle.center.y();
      is_near[k] = std::abs(std::sqrt(x * x + y * y) - circle.radius) <= tolerance_m ? 1 : 0;
      num_near += is_near[k];
    }
    if (static_cast<float>(num_near) < kMinNearShare * static_cast<float>(size_)) return false;
    std::uint64_t sectors = 0;
    for (std::size_t k = 0; k < size_ && std::popcount(sectors) < kMinSectors; ++k) {
      if (is_near[k] == 0) continue;
      const float turn = std::atan2(y_[k] - circle.center.y(), x_[k] - circle.center.x());
      const float part = turn / (2 * std::numbers::pi_v<float>)+0.5f;
      sectors |= std::uint64_t{1} << std::min(kSectors - 1, static_cast<int>(part * kSectors));
    }
    return std::popcount(sectors) >= kMinSectors;
  }

  [[nodiscard]] const Eigen::Vector2f& mean() const { return mean_; }

 private:
  std::array<float, kMostPoints + kPointPadding> x_, y_;
  std::size_t size_;
  Eigen::Vector2f mean_ = Eigen::Vector2f::Zero();
};

}  // namespace

std::optional<Circle> fit_circle(std::span<const Eigen::Vector2f> points, float max_radius_m,
                                 float tolerance_m) {
  if (points.size() < kMinPoints) return std::nullopt;
  const Sample sample(points, circle_step(points.size()));
  Circle circle;
  for (int round = 0; round < 4; ++round) {
    circle = sample.fit({circle.center.x(), circle.center.y(), circle.radius, round == 0 ? 0 : 1 / kScale});
    if (!(circle.radius <= max_radius_m)) return std::nullopt;
  }
  if (!sample.is_described_by(circle, tolerance_m)) return std::nullopt;
  circle.center += sample.mean();
  return circle;
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/draw/projection.hpp"

#include <algorithm>
#include <vector>

namespace graspd {
namespace {

constexpr float kNearest = 0.01f;    // before a camera [m]
constexpr float kMargin = 0.06f;     // of the picture's width and height, on each side
constexpr float kSmallest = 0.001f;  // extent that a picture shows at least [m, or m at 1 m]

struct Interval {
  float min = 0, max = 0;
};

/// Without the outermost points.
Interval middle(std::vector<float>& values, float left_out) {
  const auto cut = static_cast<std::ptrdiff_t>(left_out * static_cast<float>(values.size()));
  const auto low = values.begin() + cut;
  const auto high = values.end() - 1 - cut;
  std::nth_element(values.begin(), low, values.end());
  const float min = *low;
  std::nth_element(values.begin(), high, values.end());
  return {min, *high};
}

}  // namespace

void Projection::fit(std::span<const Eigen::Vector3f> points, float left_out, int width, int height) {
  std::vector<float> u, v;
  for (const Eigen::Vector3f& point : points) {
    const Eigen::Vector3f in_view = T_view_frame_ * point;
    if (!in_view.allFinite() || (kind_ == Kind::kCamera && in_view.z() < kNearest)) continue;
    u.push_back(flat(in_view).x());
    v.push_back(flat(in_view).y());
  }
  const Eigen::Vector2f size(static_cast<float>(width), static_cast<float>(height));
  offset_ = 0.5f * size;
  if (u.empty()) return;
  const Interval in_u = middle(u, left_out), in_v = middle(v, left_out);
  const Eigen::Vector2f extent(std::max(in_u.max - in_u.min, kSmallest),
                               std::max(in_v.max - in_v.min, kSmallest));
  scale_ = (1 - 2 * kMargin) * (size.array() / extent.array()).minCoeff();
  offset_ -= 0.5f * scale_ * Eigen::Vector2f(in_u.min + in_u.max, in_v.min + in_v.max);
}

std::optional<Projected> Projection::project(const Eigen::Vector3f& point, float towards_viewer_m) const {
  const Eigen::Vector3f in_view = T_view_frame_ * point;
  const float depth = in_view.z() - towards_viewer_m;
  if (!in_view.allFinite() || (kind_ == Kind::kCamera && (in_view.z() < kNearest || depth < kNearest)))
    return std::nullopt;
  const Eigen::Vector2f place = scale_ * flat(in_view) + offset_;
  return Projected{place.x(), place.y(), kind_ == Kind::kCamera ? 1 / depth : -depth};
}

Eigen::Vector2f Projection::flat(const Eigen::Vector3f& in_view) const {
  if (kind_ == Kind::kParallel) return in_view.head<2>();
  return in_view.head<2>() / in_view.z();
}

Eigen::Isometry3f looking(const Eigen::Vector3f& position, const Eigen::Vector3f& forward,
                          const Eigen::Vector3f& up) {
  const Eigen::Vector3f z = forward.normalized();
  Eigen::Vector3f y = up.dot(z) * z - up;
  if (y.norm() < 1e-3f * up.norm()) y = z.unitOrthogonal();
  y.normalize();
  Eigen::Isometry3f T = Eigen::Isometry3f::Identity();
  T.linear().row(0) = y.cross(z);
  T.linear().row(1) = y;
  T.linear().row(2) = z;
  T.translation() = -(T.linear() * position);
  return T;
}

}  // namespace graspd

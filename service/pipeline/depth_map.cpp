// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/depth_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace graspd {
namespace {

/// Wider views are cut off: what is outside the image counts as seen.
constexpr float kMaxSlope = 2.0f;
constexpr int kMaxSide = 1024;

Eigen::Matrix3f looking_along(const Eigen::Vector3f& forward) {
  Eigen::Matrix3f axes;
  // The optical frame's own axes for a sensor that looks along z, so that image rows stay rows.
  Eigen::Vector3f right = Eigen::Vector3f::UnitY().cross(forward);
  if (right.norm() < 0.1f) right = Eigen::Vector3f::UnitX();
  right = (right - right.dot(forward) * forward).normalized();
  axes.row(0) = right;
  axes.row(1) = forward.cross(right);
  axes.row(2) = forward;
  return axes;
}

}  // namespace

DepthMap::DepthMap(const PointCloud& cloud)
    : viewpoint_(cloud.viewpoint), to_view_(Eigen::Matrix3f::Identity()) {
  if (cloud.empty()) return;
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (std::size_t i = 0; i < cloud.size(); ++i) sum += (cloud.point(i) - viewpoint_).normalized();
  if (sum.norm() < 1e-3f) return;
  to_view_ = looking_along(sum.normalized());

  float left = kMaxSlope, right = -kMaxSlope, top = kMaxSlope, bottom = -kMaxSlope;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3f q = to_view_ * (cloud.point(i) - viewpoint_);
    if (q.z() <= 0) continue;
    left = std::min(left, q.x() / q.z());
    right = std::max(right, q.x() / q.z());
    top = std::min(top, q.y() / q.z());
    bottom = std::max(bottom, q.y() / q.z());
  }
  left = std::max(left, -kMaxSlope);
  right = std::min(right, kMaxSlope);
  top = std::max(top, -kMaxSlope);
  bottom = std::min(bottom, kMaxSlope);
  if (right <= left || bottom <= top) return;
  // About one pixel a point, so that a closed surface leaves few gaps and an edge stays where it is.
  // Points on nearly one ray would have pixels beyond all numbers.
  constexpr float kMinSide = 1e-6f;
  const float area = std::max((right - left) * (bottom - top), kMinSide * kMinSide);
  focal_ = std::sqrt(static_cast<float>(cloud.size()) / area);
  focal_ =
      std::min(focal_, static_cast<float>(kMaxSide - 4) / std::max({right - left, bottom - top, kMinSide}));
  width_ = static_cast<int>(focal_ * (right - left)) + 3;
  height_ = static_cast<int>(focal_ * (bottom - top)) + 3;
  center_u_ = 1 - focal_ * left;
  center_v_ = 1 - focal_ * top;
  splat(cloud);
  close_gaps(std::max(width_, height_) / 10);
}

bool DepthMap::project(const Eigen::Vector3f& p, int& u, int& v, float& depth) const {
  const Eigen::Vector3f q = to_view_ * (p - viewpoint_);
  if (!(q.z() > 0)) return false;
  const float fu = focal_ * q.x() / q.z() + center_u_ + 0.5f, fv = focal_ * q.y() / q.z() + center_v_ + 0.5f;
  if (!(fu >= 0 && fv >= 0 && fu < static_cast<float>(width_) && fv < static_cast<float>(height_)))
    return false;
  u = static_cast<int>(fu);
  v = static_cast<int>(fv);
  depth = q.z();
  return true;
}

void DepthMap::splat(const PointCloud& cloud) {
  const auto size = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  depth_.assign(size, 0);
  point_.assign(size, kFree);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    int u = 0, v = 0;
    float depth = 0;
    if (!project(cloud.point(i), u, v, depth)) continue;
    const std::size_t k =
        static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u);
    if (depth_[k] != 0 && depth_[k] <= depth) continue;
    depth_[k] = depth;
    point_[k] = static_cast<std::int32_t>(i);
  }
}

/// Gaps in a row take the farther of their two ends: shadows of a projector lie on what is behind.
void DepthMap::close_gaps(int max_gap) {
  for (int v = 0; v < height_; ++v) {
    const std::size_t row = static_cast<std::size_t>(v) * static_cast<std::size_t>(width_);
    int last = -1;
    for (int u = 0; u < width_; ++u) {
      const std::size_t k = row + static_cast<std::size_t>(u);
      if (depth_[k] == 0) continue;
      if (last >= 0 && u - last > 1 && u - last <= max_gap) {
        const std::size_t from = row + static_cast<std::size_t>(last);
        const std::size_t far = depth_[k] > depth_[from] ? k : from;
        std::fill(depth_.begin() + static_cast<std::ptrdiff_t>(from) + 1,
                  depth_.begin() + static_cast<std::ptrdiff_t>(k), depth_[far]);
        std::fill(point_.begin() + static_cast<std::ptrdiff_t>(from) + 1,
                  point_.begin() + static_cast<std::ptrdiff_t>(k), point_[far]);
      }
      last = u;
    }
  }
}

float DepthMap::ray_area(const Eigen::Vector3f& p) const {
  const float depth = to_view_.row(2).dot(p - viewpoint_);
  return depth * depth / (focal_ * focal_);
}

std::int32_t DepthMap::hider(const Eigen::Vector3f& p, float margin_m) const {
  int u = 0, v = 0;
  float depth = 0;
  if (depth_.empty() || !project(p, u, v, depth)) return kFree;
  const std::size_t k =
      static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u);
  return depth_[k] > 0 && depth_[k] < depth - margin_m ? point_[k] : kFree;
}

}  // namespace graspd

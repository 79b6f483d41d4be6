// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/near_points.hpp"

#include <algorithm>
#include <limits>

namespace graspd {

NearPoints::NearPoints(const PointCloud& cloud, std::span<const std::uint32_t> points)
    : points_(cloud, points) {
  constexpr float kFar = std::numeric_limits<float>::max();
  for (std::size_t from = 0; from < points_.size(); from += kBlock) {
    const PointRange part = points_.range(from, std::min(from + kBlock, points_.size()));
    Eigen::Array3f low(kFar, kFar, kFar), high = -low;
    point_kernels().extend_bounds(part.x, part.size, low.x(), high.x());
    point_kernels().extend_bounds(part.y, part.size, low.y(), high.y());
    point_kernels().extend_bounds(part.z, part.size, low.z(), high.z());
    low_.push_back(low);
    high_.push_back(high);
  }
}

std::span<const std::uint32_t> NearPoints::within(const Eigen::Vector3f& p, float distance_m,
                                                  Buffer& buffer) const {
  const float reach = distance_m + 1e-5f;
  buffer.spans.clear();
  if (const std::size_t room = points_.size() + kPointPadding; buffer.near.size() < room)
    buffer.near.resize(room);
  for (std::size_t k = 0; k < low_.size(); ++k)
    if ((p.array() >= low_[k] - reach).all() && (p.array() <= high_[k] + reach).all())
      buffer.spans.push_back({static_cast<std::uint32_t>(k * kBlock),
                              static_cast<std::uint32_t>(std::min((k + 1) * kBlock, points_.size()))});
  const std::size_t n = point_kernels().keep_near({p.x(), p.y(), p.z()}, distance_m * distance_m,
                                                  points_.all(), buffer.spans, buffer.near.data());
  return {buffer.near.data(), n};
}

}  // namespace graspd

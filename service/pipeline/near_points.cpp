// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/near_points.hpp"

#include <algorithm>
#include <limits>

namespace graspd {

NearPoints::NearPoints(const PointCloud& cloud, std::span<const std::uint32_t> points)
    : points_(cloud, points) {
  constexpr float kFar = std::numeric_limits<float>::max();
  const std::size_t num_blocks = (points_.size() + kBlock - 1) / kBlock;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    low_[axis].assign(num_blocks, kFar);
    high_[axis].assign(num_blocks, -kFar);
  }
  for (std::size_t k = 0; k < num_blocks; ++k) {
    const PointRange part = points_.range(k * kBlock, std::min((k + 1) * kBlock, points_.size()));
    const std::array<const float*, 3> axes{part.x, part.y, part.z};
    for (std::size_t axis = 0; axis < 3; ++axis)
      point_kernels().extend_bounds(axes[axis], part.size, low_[axis][k], high_[axis][k]);
  }
}

void NearPoints::test_blocks(const Eigen::Vector3f& p, float half_m, std::int32_t* is_near) const {
  const Eigen::Vector3f from = p.array() - half_m, to = p.array() + half_m;
  const float fx = from.x(), fy = from.y(), fz = from.z(), tx = to.x(), ty = to.y(), tz = to.z();
  const float *lx = low_[0].data(), *ly = low_[1].data(), *lz = low_[2].data(), *hx = high_[0].data(),
              *hy = high_[1].data(), *hz = high_[2].data();
  const std::size_t num = low_[0].size();
  for (std::size_t k = 0; k < num; ++k)
    is_near[k] = int{lx[k] <= tx} & int{ly[k] <= ty} & int{lz[k] <= tz} & int{hx[k] >= fx} &
                 int{hy[k] >= fy} & int{hz[k] >= fz};
}

std::span<const std::uint32_t> NearPoints::within(const Eigen::Vector3f& p, float distance_m,
                                                  Buffer& buffer) const {
  buffer.is_near.resize(low_[0].size());
  if (const std::size_t room = points_.size() + kPointPadding; buffer.near.size() < room)
    buffer.near.resize(room);
  test_blocks(p, distance_m + 1e-5f, buffer.is_near.data());
  buffer.spans.clear();
  for (std::size_t k = 0; k < buffer.is_near.size(); ++k)
    if (buffer.is_near[k] != 0)
      buffer.spans.push_back({static_cast<std::uint32_t>(k * kBlock),
                              static_cast<std::uint32_t>(std::min((k + 1) * kBlock, points_.size()))});
  const std::size_t n = point_kernels().keep_near({p.x(), p.y(), p.z()}, distance_m * distance_m,
                                                  points_.all(), buffer.spans, buffer.near.data());
  return {buffer.near.data(), n};
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/workspace_filter.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace graspd {
namespace {

struct Kept {
  int finite = 0, inside = 0;
};

/// Copies the points from [begin, end) that are wanted to kept, from begin on, and the positions they had to
/// positions where that is not null.
Kept keep_inside(const PointCloud& cloud, const WorkspaceFilterConfig& config, std::size_t begin,
                 std::size_t end, PointCloud& kept, std::uint32_t* positions) {
  const float nearest = config.min_range_m * config.min_range_m;
  const float farthest = config.max_range_m * config.max_range_m;
  const Eigen::Matrix3f R = config.T_box_cloud.linear();
  const Eigen::Vector3f t = config.T_box_cloud.translation(), lo = config.min_m, hi = config.max_m,
                        origin = cloud.viewpoint;
  constexpr std::size_t kBlock = 64;
  int inside[kBlock];
  Kept count;
  std::size_t n = begin;
  for (; begin < end; begin += kBlock) {
    const std::size_t size = std::min(kBlock, end - begin);
    const float *xs = cloud.x.data() + begin, *ys = cloud.y.data() + begin, *zs = cloud.z.data() + begin;
    for (std::size_t k = 0; k < size; ++k) {
      const float x = xs[k], y = ys[k], z = zs[k];
      const float dx = x - origin.x(), dy = y - origin.y(), dz = z - origin.z();
      const float range = dx * dx + dy * dy + dz * dz;
      const float u = R(0, 0) * x + R(0, 1) * y + R(0, 2) * z + t.x(),
                  v = R(1, 0) * x + R(1, 1) * y + R(1, 2) * z + t.y(),
                  w = R(2, 0) * x + R(2, 1) * y + R(2, 2) * z + t.z();
      // The difference is NaN for what is not finite.
      const int finite = int{x - x == 0} & int{y - y == 0} & int{z - z == 0};
      count.finite += finite;
      inside[k] = finite & int{range >= nearest} & int{range <= farthest} & int{u >= lo.x()} &
                  int{u <= hi.x()} & int{v >= lo.y()} & int{v <= hi.y()} & int{w >= lo.z()} &
                  int{w <= hi.z()};
    }
    if (positions != nullptr) {
      std::uint32_t* next = positions + n;
      for (std::size_t k = 0; k < size; ++k) {
        *next = static_cast<std::uint32_t>(begin + k);
        next += inside[k];
      }
    }
    for (std::size_t k = 0; k < size; ++k) {
      kept.x[n] = xs[k];
      kept.y[n] = ys[k];
      kept.z[n] = zs[k];
      n += static_cast<std::size_t>(inside[k]);
      count.inside += inside[k];
    }
  }
  return count;
}

bool is_image(const PointCloud& cloud) {
  return cloud.width > 1 && cloud.height > 1 &&
         static_cast<std::size_t>(cloud.width) * static_cast<std::size_t>(cloud.height) == cloud.size();
}

}  // namespace

std::optional<ConfigProblem> WorkspaceFilterConfig::validate() const {
  if (!(min_m.array() < max_m.array()).all())
    return ConfigProblem{"max_m", "the workspace is empty: expected more than min_m on each axis"};
  if (min_range_m >= max_range_m)
    return ConfigProblem{"max_range_m", "the range is empty: expected more than min_range_m"};
  return std::nullopt;
}

WorkspaceResult filter_workspace(const PointCloud& cloud, const WorkspaceFilterConfig& config) {
  constexpr std::size_t kChunk = 1 << 15;
  WorkspaceResult result;
  PointCloud& kept = result.cloud;
  kept.viewpoint = cloud.viewpoint;
  kept.resize(cloud.size());
  auto& positions = result.pixels.of_point;
  if (is_image(cloud)) {
    result.pixels.width = cloud.width;
    result.pixels.height = cloud.height;
    positions.resize(cloud.size());
  }
  std::pmr::vector<Kept> counts((cloud.size() + kChunk - 1) / kChunk);
  tbb::parallel_for(std::size_t{0}, counts.size(), [&](std::size_t c) {
    counts[c] = keep_inside(cloud, config, c * kChunk, std::min((c + 1) * kChunk, cloud.size()), kept,
                            positions.empty() ? nullptr : positions.data());
  });
  std::size_t n = 0;
  for (std::size_t c = 0; c < counts.size(); ++c) {
    const auto inside = static_cast<std::size_t>(counts[c].inside);
    for (float* v : {kept.x.data(), kept.y.data(), kept.z.data()}) std::copy_n(v + c * kChunk, inside, v + n);
    if (!positions.empty()) std::copy_n(positions.data() + c * kChunk, inside, positions.data() + n);
    n += inside;
    result.num_finite += static_cast<std::size_t>(counts[c].finite);
  }
  kept.resize(n);
  kept.width = static_cast<int>(n);
  if (!positions.empty()) positions.resize(n);
  return result;
}

}  // namespace graspd

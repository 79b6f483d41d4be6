// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/smoothing.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace graspd {

int smoothing_iterations(const SmoothingConfig& config, float scatter_m) {
  constexpr int kMost = 4;
  if (config.from_scatter_m == 0 || scatter_m < config.from_scatter_m) return config.iterations;
  const float more = (scatter_m - config.from_scatter_m) / config.scatter_step_m;
  return std::max(config.iterations, 1 + static_cast<int>(std::min(more, static_cast<float>(kMost - 1))));
}

PointCloud smooth(const PointCloud& cloud, const Normals& normals, const Neighborhoods& neighborhoods) {
  constexpr float kMinCosine = 0.9063f;  // 25 degrees
  PointCloud moved = cloud;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cloud.size(), 1024), [&](const auto& range) {
    for (std::size_t s = range.begin(); s != range.end(); ++s) {
      const Eigen::Vector3f p = cloud.point(s), n = normals.at(s);
      float sum = 0, count = 0;
      for (const std::uint32_t i : neighborhoods.of(s)) {
        if (normals.at(i).dot(n) < kMinCosine) continue;
        sum += n.dot(cloud.point(i) - p);
        count += 1;
      }
      // Near an edge many normals differ, and the mean of both faces lies inside the object.
      if (count < 0.8f * static_cast<float>(neighborhoods.of(s).size()) || count == 0) continue;
      const Eigen::Vector3f q = p + n * (sum / count);
      moved.x[s] = q.x();
      moved.y[s] = q.y();
      moved.z[s] = q.z();
    }
  });
  return moved;
}

}  // namespace graspd

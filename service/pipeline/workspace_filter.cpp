// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/workspace_filter.hpp"

#include <cmath>

namespace graspd {

std::optional<ConfigProblem> WorkspaceFilterConfig::validate() const {
  if (!(min_m.array() < max_m.array()).all())
    return ConfigProblem{"max_m", "the workspace is empty: expected more than min_m on each axis"};
  if (min_range_m >= max_range_m)
    return ConfigProblem{"max_range_m", "the range is empty: expected more than min_range_m"};
  return std::nullopt;
}

WorkspaceResult filter_workspace(const PointCloud& cloud, const WorkspaceFilterConfig& config) {
  WorkspaceResult result;
  PointCloud& kept = result.cloud;
  kept.viewpoint = cloud.viewpoint;
  kept.resize(cloud.size());
  const float nearest = config.min_range_m * config.min_range_m;
  const float farthest = config.max_range_m * config.max_range_m;
  std::size_t n = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3f p = cloud.point(i);
    if (!std::isfinite(p.x()) || !std::isfinite(p.y()) || !std::isfinite(p.z())) continue;
    ++result.num_finite;
    const float range = (p - cloud.viewpoint).squaredNorm();
    const Eigen::Vector3f q = config.T_box_cloud * p;
    const bool inside =
        (q.array() >= config.min_m.array()).all() && (q.array() <= config.max_m.array()).all();
    kept.x[n] = p.x();
    kept.y[n] = p.y();
    kept.z[n] = p.z();
    n += static_cast<std::size_t>(inside && range >= nearest && range <= farthest);
  }
  kept.resize(n);
  kept.width = static_cast<int>(n);
  return result;
}

}  // namespace graspd

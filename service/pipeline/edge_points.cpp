// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/edge_points.hpp"

#include <tbb/parallel_for.h>

#include <cmath>
#include <numbers>

#include "service/pipeline/point_kernels.hpp"

namespace graspd {

std::optional<ConfigProblem> SmoothnessConfig::validate() const {
  if (theta_low_deg > theta_high_deg)
    return ConfigProblem{"theta_low_deg",
                         "the lower threshold is the larger one: expected at most theta_high_deg"};
  return std::nullopt;
}

std::pmr::vector<std::uint8_t> find_edge_points(const Normals& normals, const Neighborhoods& neighborhoods,
                                                const SmoothnessConfig& config) {
  const float cos_high = std::cos(config.theta_high_deg * std::numbers::pi_v<float> / 180);
  const NormalArrays arrays = normals.arrays();
  const PointKernels& kernels = point_kernels();
  std::pmr::vector<std::uint8_t> is_edge(normals.size());
  const std::span<const std::uint32_t> points = neighborhoods.points();
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 512), [&](const auto& range) {
    for (const std::uint32_t s : points.subspan(range.begin(), range.size())) {
      const std::span<const std::uint32_t> near = neighborhoods.of(s);
      const bool has_normal = normals.x[s] != 0 || normals.y[s] != 0 || normals.z[s] != 0;
      is_edge[s] = has_normal ? 0 : 1;
      if (!has_normal) continue;
      const std::size_t bent = kernels.count_bent(arrays, s, cos_high, near.data(), near.size());
      is_edge[s] = static_cast<float>(bent) > config.edge_share * static_cast<float>(near.size()) ? 1 : 0;
    }
  });
  return is_edge;
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/edge_points.hpp"

#include <tbb/parallel_for.h>

#include <cmath>
#include <numbers>

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
  std::pmr::vector<std::uint8_t> is_edge(normals.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, normals.size(), 1024), [&](const auto& range) {
    for (std::size_t s = range.begin(); s != range.end(); ++s) {
      const float nx = normals.x[s], ny = normals.y[s], nz = normals.z[s];
      int above = 0;
      for (const std::uint32_t i : neighborhoods.of(s))
        above += nx * normals.x[i] + ny * normals.y[i] + nz * normals.z[i] < cos_high ? 1 : 0;
      const bool has_normal = nx != 0 || ny != 0 || nz != 0;
      is_edge[s] = !has_normal || static_cast<float>(above) >
                                      config.edge_share * static_cast<float>(neighborhoods.of(s).size());
    }
  });
  return is_edge;
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/region_growing.hpp"

#include <cmath>
#include <numbers>

#include "service/pipeline/union_find.hpp"

namespace graspd {
namespace {

float cos_deg(float angle_deg) {
  return std::cos(angle_deg * std::numbers::pi_v<float> / 180);
}

UnionFind link(const Normals& normals, const Neighborhoods& neighborhoods,
               const std::pmr::vector<std::uint8_t>& is_edge, const std::pmr::vector<std::uint8_t>& excluded,
               const SmoothnessConfig& config) {
  const float cos_low = cos_deg(config.theta_low_deg), cos_high = cos_deg(config.theta_high_deg);
  UnionFind sets(normals.size());
  for (std::uint32_t s = 0; s < normals.size(); ++s) {
    if (!excluded.empty() && excluded[s]) continue;
    std::uint32_t root = sets.find(s);
    for (const std::uint32_t p : neighborhoods.of(s)) {
      if (p <= s || (!excluded.empty() && excluded[p])) continue;
      const std::uint32_t other = sets.find(p);
      if (other == root) continue;
      const float cosine =
          normals.x[s] * normals.x[p] + normals.y[s] * normals.y[p] + normals.z[s] * normals.z[p];
      const float least = is_edge[s] | is_edge[p] ? cos_low : cos_high;
      if (cosine <= least) continue;
      sets.unite(root, other);
      root = sets.find(s);
    }
  }
  return sets;
}

/// Label of the neighbour with the most similar normal that has one, or -1.
std::int32_t most_similar_label(const Normals& normals, std::span<const std::uint32_t> neighborhood,
                                std::size_t s, const std::pmr::vector<std::int32_t>& labels) {
  std::int32_t label = -1;
  float best = -2;
  for (const std::uint32_t p : neighborhood) {
    const float cosine = normals.at(s).dot(normals.at(p));
    if (labels[p] < 0 || cosine <= best) continue;
    best = cosine;
    label = labels[p];
  }
  return label;
}

}  // namespace

Labels grow_regions(const Normals& normals, const Neighborhoods& neighborhoods,
                    const std::pmr::vector<std::uint8_t>& is_edge,
                    const std::pmr::vector<std::uint8_t>& excluded, const SmoothnessConfig& config) {
  const std::size_t n = normals.size();
  const auto takes_part = [&excluded](std::size_t s) { return excluded.empty() || !excluded[s]; };
  UnionFind sets = link(normals, neighborhoods, is_edge, excluded, config);
  std::pmr::vector<std::uint8_t> has_surface(
      n);  // by representative: the component has a point that is no edge point
  for (std::uint32_t s = 0; s < n; ++s)
    if (!is_edge[s] && takes_part(s)) has_surface[sets.find(s)] = 1;

  Labels result;
  std::pmr::vector<std::int32_t> label_of_root(n, -1), grown(n, -1);
  for (std::uint32_t s = 0; s < n; ++s) {
    const std::uint32_t root = sets.find(s);
    if (!has_surface[root]) continue;
    if (label_of_root[root] < 0) label_of_root[root] = result.num_labels++;
    grown[s] = label_of_root[root];
  }
  result.of_point = grown;
  for (std::size_t s = 0; s < n; ++s)
    if (grown[s] < 0 && takes_part(s))
      result.of_point[s] = most_similar_label(normals, neighborhoods.of(s), s, grown);
  return result;
}

}  // namespace graspd

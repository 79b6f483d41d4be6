// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/queue_growing.hpp"

#include <cmath>
#include <deque>
#include <map>
#include <numbers>

namespace graspd {

std::pmr::vector<std::int32_t> grow_by_queue(const Normals& normals, const Neighborhoods& neighborhoods,
                                             const std::pmr::vector<std::uint8_t>& is_edge,
                                             const SmoothnessConfig& config,
                                             const std::pmr::vector<std::uint32_t>& seeds) {
  const float low = std::cos(config.theta_low_deg * std::numbers::pi_v<float> / 180);
  const float high = std::cos(config.theta_high_deg * std::numbers::pi_v<float> / 180);
  std::pmr::vector<std::int32_t> label(normals.size(), -1);
  std::int32_t num_labels = 0;
  for (const std::uint32_t first : seeds) {
    if (label[first] >= 0) continue;
    label[first] = num_labels++;
    std::deque<std::uint32_t> queue{first};
    while (!queue.empty()) {
      const std::uint32_t s = queue.front();
      queue.pop_front();
      for (const std::uint32_t p : neighborhoods.of(s)) {
        const float cosine = normals.at(s).dot(normals.at(p));
        if (label[p] >= 0 || cosine < high) continue;
        label[p] = label[s];
        if (cosine > low || !is_edge[s]) queue.push_back(p);
      }
    }
  }
  return label;
}

double agreement(const std::pmr::vector<std::int32_t>& a, const std::pmr::vector<std::int32_t>& b) {
  std::map<std::int32_t, std::map<std::int32_t, int>> of_a, of_b;
  int total = 0, agreed = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] < 0 || b[i] < 0) continue;
    ++total;
    ++of_a[a[i]][b[i]];
    ++of_b[b[i]][a[i]];
  }
  const auto largest = [](const std::map<std::int32_t, int>& overlaps) {
    auto best = overlaps.begin();
    for (auto it = overlaps.begin(); it != overlaps.end(); ++it)
      if (it->second > best->second) best = it;
    return best->first;
  };
  for (const auto& [label, overlaps] : of_a) {
    const std::int32_t partner = largest(overlaps);
    if (largest(of_b[partner]) == label) agreed += overlaps.at(partner);
  }
  return total == 0 ? 1 : static_cast<double>(agreed) / total;
}

}  // namespace graspd

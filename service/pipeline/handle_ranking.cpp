// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/handle_ranking.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

namespace graspd {
namespace {

/// Angle between two gripper poses [rad]; a gripper turned by half a turn about its approach is the same
/// gripper.
float angle_between(const Handle& a, const Handle& b) {
  const Eigen::Matrix3f r = a.rotation.transpose() * b.rotation;
  const float same = r.trace(), flipped = -r(0, 0) - r(1, 1) + r(2, 2);
  return std::acos(std::clamp(0.5f * (std::max(same, flipped) - 1), -1.0f, 1.0f));
}

bool same_place(const Handle& a, const Handle& b, const HandleRankingConfig& config) {
  return (a.position - b.position).norm() < config.distinct_distance_m &&
         angle_between(a, b) < config.distinct_angle_deg * std::numbers::pi_v<float> / 180;
}

/// How new a place is beside the others of its object, 1 far from all of them.
float novelty(const Handle& handle, const std::pmr::vector<const Handle*>& others, float falloff_m) {
  float nearest = std::numeric_limits<float>::infinity();
  for (const Handle* other : others)
    nearest = std::min(nearest, (handle.position - other->position).squaredNorm());
  return 1 - std::exp(-nearest / (falloff_m * falloff_m));
}

/// Adds the best places of one object, each the best of those left with regard to score and distance from the
/// ones before: a handle elsewhere on the object is worth more than the same again.
void choose_places(const std::pmr::vector<RankedHandle>& handles, std::pmr::vector<std::size_t> left,
                   const HandleRankingConfig& config, std::pmr::vector<const Handle*>& kept,
                   std::pmr::vector<std::size_t>& chosen) {
  std::pmr::vector<const Handle*> own;
  while (!left.empty() && static_cast<int>(own.size()) < config.max_per_object) {
    std::size_t best = 0;
    float best_worth = -1;
    std::erase_if(left, [&](std::size_t i) {
      return std::any_of(kept.begin(), kept.end(),
                         [&](const Handle* other) { return same_place(handles[i].handle, *other, config); });
    });
    if (!own.empty())
      std::erase_if(left, [&](std::size_t i) { return handles[i].handle.score < config.min_further_score; });
    for (const std::size_t i : left) {
      const float worth = handles[i].handle.score * novelty(handles[i].handle, own, config.spread_m);
      if (worth <= best_worth) continue;
      best_worth = worth;
      best = i;
    }
    if (left.empty()) break;
    std::erase(left, best);
    own.push_back(&handles[best].handle);
    kept.push_back(&handles[best].handle);
    chosen.push_back(best);
  }
}

/// Indices of the handles that are kept, best first. leaders: the best of each object.
std::pmr::vector<std::size_t> choose(const std::pmr::vector<RankedHandle>& handles,
                                     const HandleRankingConfig& config,
                                     std::pmr::vector<std::size_t>& leaders) {
  std::pmr::vector<std::size_t> order(handles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::erase_if(order, [&](std::size_t i) { return handles[i].handle.score < config.min_score; });
  const auto better = [&](std::size_t a, std::size_t b) {
    const float score_a = handles[a].handle.score, score_b = handles[b].handle.score;
    return score_a != score_b ? score_a > score_b : a < b;
  };
  std::sort(order.begin(), order.end(), better);
  std::pmr::map<int, std::pmr::vector<std::size_t>> of_object;
  leaders.clear();
  for (const std::size_t i : order) {
    std::pmr::vector<std::size_t>& own = of_object[handles[i].object];
    if (own.empty()) leaders.push_back(i);
    own.push_back(i);
  }
  std::pmr::vector<const Handle*> kept;
  std::pmr::vector<std::size_t> chosen;
  for (const std::size_t leader : leaders)
    choose_places(handles, of_object[handles[leader].object], config, kept, chosen);
  std::sort(chosen.begin(), chosen.end(), better);
  if (chosen.size() > static_cast<std::size_t>(config.max_handles))
    chosen.resize(static_cast<std::size_t>(config.max_handles));
  return chosen;
}

}  // namespace

std::pmr::vector<Handle> rank_handles(std::pmr::vector<RankedHandle> handles,
                                      const HandleRankingConfig& config, const SettleScores& settle) {
  std::pmr::vector<std::uint8_t> is_final(handles.size(), settle ? 0 : 1);
  std::pmr::vector<std::size_t> leaders, open;
  for (;;) {
    const std::pmr::vector<std::size_t> chosen = choose(handles, config, leaders);
    open.clear();
    leaders.insert(leaders.end(), chosen.begin(), chosen.end());
    for (const std::size_t i : leaders)
      if (!std::exchange(is_final[i], std::uint8_t{1})) open.push_back(i);
    if (open.empty()) {
      std::pmr::vector<Handle> ranked;
      ranked.reserve(chosen.size());
      for (const std::size_t i : chosen) ranked.push_back(handles[i].handle);
      return ranked;
    }
    settle(open, handles);
  }
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/handle_ranking.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <tuple>
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

/// A handle that is kept, and the score that it gets.
struct Chosen {
  std::size_t index;
  float score;
};

/// Adds the best places of one object, after its leader each the best of those left with regard to score,
/// distance from the ones before and from the middle: a handle elsewhere on the object is worth more than the
/// same again, but off its middle the object turns between the jaws.
void choose_places(const std::pmr::vector<RankedHandle>& handles, std::size_t leader,
                   std::pmr::vector<std::size_t> left, const HandleRankingConfig& config,
                   std::pmr::vector<const Handle*>& kept, std::pmr::vector<Chosen>& chosen) {
  constexpr float kAboveAll = 2, kRefuted = 0.35f;
  std::pmr::vector<const Handle*> own;
  while (!left.empty() && static_cast<int>(own.size()) < config.max_per_object) {
    std::size_t best = 0;
    float best_worth = -1;
    std::erase_if(left, [&](std::size_t i) {
      return std::any_of(kept.begin(), kept.end(),
                         [&](const Handle* other) { return same_place(handles[i].handle, *other, config); });
    });
    if (!own.empty()) {
      // Next to a first one that is all but refuted the others are not to be trusted, whatever they score.
      if (own.front()->score < kRefuted * config.min_further_score) break;
      std::erase_if(left, [&](std::size_t i) { return handles[i].handle.score < config.min_further_score; });
    }
    for (const std::size_t i : left) {
      const float worth = i == leader
                              ? kAboveAll
                              : handles[i].handle.score * novelty(handles[i].handle, own, config.spread_m) *
                                    handles[i].central;
      if (worth <= best_worth) continue;
      best_worth = worth;
      best = i;
    }
    if (left.empty()) break;
    std::erase(left, best);
    own.push_back(&handles[best].handle);
    kept.push_back(&handles[best].handle);
    chosen.push_back({best, std::min(handles[best].handle.score, own.front()->score)});
  }
}

/// The handles that are kept, best first. leaders: the first of each object.
std::pmr::vector<Chosen> choose(const std::pmr::vector<RankedHandle>& handles,
                                const HandleRankingConfig& config, std::pmr::vector<std::size_t>& leaders) {
  std::pmr::vector<std::size_t> order(handles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::erase_if(order, [&](std::size_t i) { return handles[i].handle.score < config.min_score; });
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const float score_a = handles[a].handle.score, score_b = handles[b].handle.score;
    return score_a != score_b ? score_a > score_b : a < b;
  });
  std::pmr::map<int, std::pmr::vector<std::size_t>> of_object;
  std::pmr::map<int, std::size_t> first;
  for (const std::size_t i : order) {
    of_object[handles[i].object].push_back(i);
    const auto [it, is_new] = first.try_emplace(handles[i].object, i);
    if (handles[i].is_first) it->second = i;
  }
  leaders.clear();
  std::copy_if(order.begin(), order.end(), std::back_inserter(leaders),
               [&](std::size_t i) { return first.at(handles[i].object) == i; });
  std::pmr::vector<const Handle*> kept;
  std::pmr::vector<Chosen> chosen;
  for (const std::size_t leader : leaders)
    choose_places(handles, leader, of_object[handles[leader].object], config, kept, chosen);
  std::sort(chosen.begin(), chosen.end(), [&](const Chosen& a, const Chosen& b) {
    const auto key = [&](const Chosen& c) {
      return std::tuple(-c.score, !handles[c.index].is_first, c.index);
    };
    return key(a) < key(b);
  });
  if (chosen.size() > static_cast<std::size_t>(config.max_handles))
    chosen.resize(static_cast<std::size_t>(config.max_handles));
  return chosen;
}

}  // namespace

std::pmr::vector<Handle> rank_handles(std::pmr::vector<RankedHandle> handles,
                                      const HandleRankingConfig& config, const SettleScores& settle) {
  std::pmr::vector<std::uint8_t> is_final;
  is_final.reserve(handles.size());
  for (const RankedHandle& handle : handles) is_final.push_back(!settle || handle.is_first ? 1 : 0);
  std::pmr::vector<std::size_t> leaders, open;
  for (;;) {
    const std::pmr::vector<Chosen> chosen = choose(handles, config, leaders);
    open.clear();
    for (const Chosen& c : chosen) leaders.push_back(c.index);
    for (const std::size_t i : leaders)
      if (!std::exchange(is_final[i], std::uint8_t{1})) open.push_back(i);
    if (open.empty()) {
      std::pmr::vector<Handle> ranked;
      ranked.reserve(chosen.size());
      for (const Chosen& c : chosen) {
        ranked.push_back(handles[c.index].handle);
        ranked.back().score = c.score;
      }
      return ranked;
    }
    settle(open, handles);
  }
}

}  // namespace graspd

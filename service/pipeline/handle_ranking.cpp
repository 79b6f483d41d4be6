// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/handle_ranking.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

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

}  // namespace

std::vector<Handle> rank_handles(std::vector<RankedHandle> handles, const HandleRankingConfig& config) {
  std::stable_sort(handles.begin(), handles.end(), [](const RankedHandle& a, const RankedHandle& b) {
    return a.handle.score > b.handle.score;
  });
  std::vector<Handle> kept;
  std::map<int, int> count;
  for (const RankedHandle& ranked : handles) {
    const Handle& handle = ranked.handle;
    if (static_cast<int>(kept.size()) == config.max_handles) break;
    if (handle.score < config.min_score || count[ranked.object] == config.max_per_object) continue;
    const auto near = [&](const Handle& other) { return same_place(handle, other, config); };
    if (std::any_of(kept.begin(), kept.end(), near)) continue;
    ++count[ranked.object];
    kept.push_back(handle);
  }
  return kept;
}

}  // namespace graspd

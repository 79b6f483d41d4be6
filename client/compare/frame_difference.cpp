// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/compare/frame_difference.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "client/common/handle_text.hpp"

namespace graspd {
namespace {

constexpr double kNearM = 0.02;
const double kCosNear = std::cos(30 * std::numbers::pi / 180);

double dot(const double (&a)[3], const double (&b)[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double distance_m(const handle_t& a, const handle_t& b) {
  return std::hypot(a.position[0] - b.position[0], a.position[1] - b.position[1],
                    a.position[2] - b.position[2]);
}

bool alike(const handle_t& a, const handle_t& b) {
  return distance_m(a, b) <= kNearM && dot(a.approach, b.approach) >= kCosNear &&
         std::abs(dot(a.closing_axis, b.closing_axis)) >= kCosNear;
}

int count_counterparts(const handle_list_t& before, const handle_list_t& after) {
  std::vector<bool> taken(after.handles.size());
  int found = 0;
  for (const handle_t& handle : before.handles) {
    std::size_t nearest = after.handles.size();
    for (std::size_t i = 0; i < after.handles.size(); ++i) {
      if (taken[i] || !alike(handle, after.handles[i])) continue;
      if (nearest == after.handles.size() ||
          distance_m(handle, after.handles[i]) < distance_m(handle, after.handles[nearest]))
        nearest = i;
    }
    if (nearest == after.handles.size()) continue;
    taken[nearest] = true;
    ++found;
  }
  return found;
}

double best_score(const handle_list_t& list) {
  return list.handles.empty() ? 0 : list.handles.front().score;
}

double half_share(int part, int all) {
  return all > 0 ? 0.5 * part / all : 0;
}

}  // namespace

double FrameDifference::net_loss() const {
  return best_before - best_after + half_share(lost, handles_before) - half_share(gained, handles_after);
}

FrameDifference difference(const handle_list_t& before, const handle_list_t& after) {
  FrameDifference d;
  d.key = {after.source_channel, after.utime, after.seq, 0};
  d.status_before = status_name(before.status);
  d.status_after = status_name(after.status);
  d.handles_before = before.num_handles;
  d.handles_after = after.num_handles;
  const int common = count_counterparts(before, after);
  d.lost = d.handles_before - common;
  d.gained = d.handles_after - common;
  d.best_before = best_score(before);
  d.best_after = best_score(after);
  return d;
}

}  // namespace graspd

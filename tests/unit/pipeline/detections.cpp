// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/pipeline/detections.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace graspd {
namespace {

template <class Vector>
bool same_floats(const Vector& a, const Vector& b, int n) {
  for (int i = 0; i < n; ++i)
    if (std::bit_cast<std::uint32_t>(a.data()[i]) != std::bit_cast<std::uint32_t>(b.data()[i])) return false;
  return true;
}

bool same_handle(const Handle& a, const Handle& b) {
  const std::array<float, 2> a_scalars{a.width_m, a.score}, b_scalars{b.width_m, b.score};
  return same_floats(a.position, b.position, 3) && same_floats(a.rotation, b.rotation, 9) &&
         same_floats(a_scalars, b_scalars, 2) && same_floats(a.gap_m, b.gap_m, 2) &&
         same_floats(a.observed_free, b.observed_free, 2) && a.segment == b.segment &&
         a.num_points == b.num_points;
}

bool same_report(const SegmentReport& a, const SegmentReport& b) {
  return same_floats(a.centroid, b.centroid, 3) && a.num_points == b.num_points && a.object == b.object &&
         a.num_candidates == b.num_candidates && a.num_handles == b.num_handles && a.failures == b.failures;
}

}  // namespace

bool same_bits(const Detection& a, const Detection& b) {
  return a.status == b.status && a.points_in == b.points_in && a.points_used == b.points_used &&
         a.num_candidates == b.num_candidates && a.candidate_failures == b.candidate_failures &&
         std::equal(a.segments.begin(), a.segments.end(), b.segments.begin(), b.segments.end(),
                    [](const SegmentReport& x, const SegmentReport& y) { return same_report(x, y); }) &&
         std::equal(a.handles.begin(), a.handles.end(), b.handles.begin(), b.handles.end(),
                    [](const Handle& x, const Handle& y) { return same_handle(x, y); });
}

GripDifference difference(const Handle& a, const Handle& b) {
  const Eigen::Matrix3f r = a.rotation.transpose() * b.rotation;
  const float trace = std::max(r.trace(), -r(0, 0) - r(1, 1) + r(2, 2));
  const float angle = std::acos(std::clamp(0.5f * (trace - 1), -1.0f, 1.0f));
  return {(a.position - b.position).norm(), angle * 180 / std::numbers::pi_v<float>,
          std::abs(a.width_m - b.width_m)};
}

double share_found(const std::pmr::vector<Handle>& a, const std::pmr::vector<Handle>& b,
                   const GripDifference& tolerance) {
  const auto found = [&](const Handle& handle) {
    return std::any_of(b.begin(), b.end(), [&](const Handle& other) {
      const GripDifference d = difference(handle, other);
      return d.distance_m <= tolerance.distance_m && d.angle_deg <= tolerance.angle_deg &&
             d.width_m <= tolerance.width_m;
    });
  };
  if (a.empty()) return 1;
  return static_cast<double>(std::count_if(a.begin(), a.end(), found)) / static_cast<double>(a.size());
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Comparing detections: the same bits, or the same grips up to a tolerance.
#pragma once
#include <memory_resource>
#include <vector>

#include "service/pipeline/detect_handles.hpp"

namespace graspd {

/// Every field of both, to the bit.
[[nodiscard]] bool same_bits(const Detection& a, const Detection& b);

struct GripDifference {
  float distance_m = 0;
  float angle_deg = 0;  ///< a gripper turned by half a turn about its approach is the same
  float width_m = 0;
};
[[nodiscard]] GripDifference difference(const Handle& a, const Handle& b);

/// Share of the handles of a that have one in b within the tolerance; 1 when a has none.
[[nodiscard]] double share_found(const std::pmr::vector<Handle>& a, const std::pmr::vector<Handle>& b,
                                 const GripDifference& tolerance);

}  // namespace graspd

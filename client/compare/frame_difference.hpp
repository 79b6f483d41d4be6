// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What became of one frame from one run to the other.
#pragma once
#include <compare>
#include <cstdint>
#include <string>

#include "graspd/handle_list_t.hpp"

namespace graspd {

/// Which cloud a list answers; `repeat` counts clouds with the same channel, time and number.
struct FrameKey {
  std::string channel;
  std::int64_t utime = 0;
  std::int64_t seq = 0;
  std::int64_t repeat = 0;
  auto operator<=>(const FrameKey&) const = default;
};

struct FrameDifference {
  FrameKey key;
  std::int64_t frame = 0;  ///< number in the log of the second run, from 0
  std::string status_before;
  std::string status_after;
  int handles_before = 0;
  int handles_after = 0;
  int lost = 0;            ///< handles of the first run that have no counterpart in the second
  int gained = 0;          ///< the other way round
  double best_before = 0;  ///< score of the best handle; 0: none
  double best_after = 0;

  /// How much worse the frame got; negative: better. What the best score lost, and half the share of handles
  /// that were lost, less what was gained in the same way.
  [[nodiscard]] double net_loss() const;
};

/// Handles are each other's counterparts within 20 mm, 30 degrees between the approaches and 30 degrees
/// between the closing axes, whose sign does not count; each has one at most, the nearest first by rank.
[[nodiscard]] FrameDifference difference(const handle_list_t& before, const handle_list_t& after);

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Small statistics for the status: latencies, rates, gaps in sequence numbers. None is safe for threads by
// itself.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "service/runtime/clock.hpp"

namespace graspd {

/// The last 256 values.
class LatencyWindow {
 public:
  static constexpr std::size_t kSize = 256;

  void add(double seconds);
  /// The smallest value that a share of at least `share` (0, 1] of the values does not exceed; 0 when there
  /// are none.
  [[nodiscard]] double percentile(double share) const;

 private:
  std::array<double, kSize> values_{};
  std::size_t count_ = 0;  // ever added
};

/// How often something happens.
class RateMeter {
 public:
  /// Events a second since the last call; 0 at the first one.
  [[nodiscard]] double update(std::int64_t total, Clock::TimePoint now);

 private:
  std::int64_t last_total_ = 0;
  Clock::TimePoint last_time_{};
  bool started_ = false;
};

/// Counts the numbers that are left out. A number that goes back, or ahead further than any network loses, is
/// a new start of the sender.
class SequenceGaps {
 public:
  static constexpr std::uint64_t kLargestGap = 1'000'000;

  /// Negative: unknown, not counted.
  void add(std::int64_t seq);
  [[nodiscard]] std::int64_t lost() const { return lost_; }

 private:
  std::int64_t last_ = -1;
  std::int64_t lost_ = 0;
};

}  // namespace graspd

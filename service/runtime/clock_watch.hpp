// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Notices when the wall clock is set.
#pragma once
#include <chrono>
#include <cstdint>
#include <optional>

#include "service/runtime/clock.hpp"

namespace graspd {

/// Compares the wall clock with the steady one. Not safe for threads.
class ClockWatch {
 public:
  /// The clocks may part by this much between two looks: more than any slewing, less than any step that
  /// matters.
  static constexpr std::chrono::milliseconds kTolerance{20};
  /// After a jump wall times from before it may still be under way.
  static constexpr std::chrono::seconds kDoubt{1};

  /// To be called before wall times are used, and often. By how much the wall clock has jumped since the last
  /// look [us], nothing when it has not.
  [[nodiscard]] std::optional<std::int64_t> look(const Clock& clock);

  /// How long ago a moment of the wall clock [us since 1970] was. Zero when that cannot be known: it lies
  /// ahead, further back than `longest`, or the clock has jumped lately.
  [[nodiscard]] Clock::TimePoint::duration since(std::int64_t wall_utime, const Clock& clock,
                                                 std::chrono::microseconds longest) const;

 private:
  std::optional<std::int64_t> offset_us_;  // wall minus steady
  std::optional<Clock::TimePoint> jump_;
};

}  // namespace graspd

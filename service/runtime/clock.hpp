// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Time as an argument, so that tests decide what time it is.
#pragma once
#include <chrono>
#include <cstdint>

namespace graspd {

class Clock {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  virtual ~Clock() = default;
  /// Never goes back; for durations.
  [[nodiscard]] virtual TimePoint now() const = 0;
  /// [us] since 1970; may jump.
  [[nodiscard]] virtual std::int64_t wall_utime() const = 0;
};

/// The machine's clocks.
class SystemClock final : public Clock {
 public:
  [[nodiscard]] TimePoint now() const override;
  [[nodiscard]] std::int64_t wall_utime() const override;
};

[[nodiscard]] inline double seconds(Clock::TimePoint::duration duration) {
  return std::chrono::duration<double>(duration).count();
}
[[nodiscard]] inline double milliseconds(Clock::TimePoint::duration duration) {
  return std::chrono::duration<double, std::milli>(duration).count();
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Decides when a source's frames are to be worked on with less effort, and when with all of it again.
#pragma once
#include <array>
#include <cstddef>
#include <mutex>

#include "service/runtime/clock.hpp"

namespace graspd {

struct LoadLimits {
  bool enabled = false;
  double above_s = 0;           ///< mean latency that is too much [s]
  double below_s = 0;           ///< mean latency that leaves room for more effort [s], less than above_s
  double above_drop_share = 1;  ///< share of dropped frames that is too much [0, 1]
  double hold_s = 0;            ///< less effort lasts this long at least [s]
  bool operator==(const LoadLimits&) const = default;
};

/// Hysteresis in level (above, below) and in time: after going back to all effort was too early, the next
/// wait is twice as long, up to kLongestHold times. All functions may be called from any thread.
class LoadControl {
 public:
  static constexpr std::size_t kLatencies = 8;  ///< latencies that the mean is over, half of them at least
  static constexpr std::size_t kFrames = 16;    ///< frames that the share is over, half of them at least
  static constexpr double kLongestHold = 8;

  /// Begins anew, with all effort, unless they are as before.
  void set_limits(const LoadLimits& limits);

  /// A frame was worked on, or dropped for a newer one. True when the effort changes with it.
  bool answered(double latency_s, Clock::TimePoint now);
  bool dropped(Clock::TimePoint now);

  [[nodiscard]] bool degraded() const;

 private:
  /// The newest n values at most, since the last change.
  template <std::size_t n>
  struct Window {
    std::array<double, n> values{};
    std::size_t count = 0;
    void add(double value) { values[count++ % n] = value; }
    [[nodiscard]] bool half_full() const { return count >= n / 2; }
    [[nodiscard]] double mean() const;
  };

  [[nodiscard]] bool decide(Clock::TimePoint now);
  [[nodiscard]] bool too_much() const;
  [[nodiscard]] bool room_for_more() const;
  void change(bool degraded, Clock::TimePoint now);

  mutable std::mutex mutex_;
  LoadLimits limits_;
  Window<kLatencies> latencies_;
  Window<kFrames> drops_;
  bool degraded_ = false;
  double hold_s_ = 0;
  Clock::TimePoint changed_{};
};

}  // namespace graspd

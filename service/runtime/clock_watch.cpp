// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/runtime/clock_watch.hpp"

#include <cstdlib>

namespace graspd {

using std::chrono::duration_cast;
using std::chrono::microseconds;

std::optional<std::int64_t> ClockWatch::look(const Clock& clock) {
  const Clock::TimePoint now = clock.now();
  const std::int64_t offset_us =
      clock.wall_utime() - duration_cast<microseconds>(now.time_since_epoch()).count();
  const std::int64_t moved_us = offset_us_ ? offset_us - *offset_us_ : 0;
  offset_us_ = offset_us;
  if (std::abs(moved_us) <= microseconds(kTolerance).count()) return std::nullopt;
  jump_ = now;
  return moved_us;
}

Clock::TimePoint::duration ClockWatch::since(std::int64_t wall_utime, const Clock& clock,
                                             microseconds longest) const {
  if (jump_ && clock.now() - *jump_ < kDoubt) return {};
  const microseconds passed(clock.wall_utime() - wall_utime);
  if (passed < microseconds::zero() || passed > longest) return {};
  return passed;
}

}  // namespace graspd

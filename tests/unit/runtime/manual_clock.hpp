// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// A clock that stands still until a test moves it.
#pragma once
#include <atomic>
#include <chrono>
#include <cstdint>

#include "service/runtime/clock.hpp"

namespace graspd {

class ManualClock final : public Clock {
 public:
  [[nodiscard]] TimePoint now() const override { return TimePoint(std::chrono::microseconds(now_us_)); }
  [[nodiscard]] std::int64_t wall_utime() const override {
    return 1'700'000'000'000'000 + now_us_ + set_by_us_;
  }
  void advance(std::chrono::microseconds by) { now_us_ += by.count(); }
  /// Somebody sets the wall clock.
  void set_wall(std::chrono::microseconds by) { set_by_us_ += by.count(); }

 private:
  std::atomic<std::int64_t> now_us_{1'000'000};
  std::atomic<std::int64_t> set_by_us_{0};
};

}  // namespace graspd

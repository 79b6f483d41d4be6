// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/runtime/load_control.hpp"

#include <algorithm>
#include <numeric>

namespace graspd {

template <std::size_t n>
double LoadControl::Window<n>::mean() const {
  const auto filled = static_cast<std::ptrdiff_t>(std::min(count, n));
  if (filled == 0) return 0;
  return std::accumulate(values.begin(), values.begin() + filled, 0.0) / static_cast<double>(filled);
}

void LoadControl::set_limits(const LoadLimits& limits) {
  const std::lock_guard lock(mutex_);
  if (limits == limits_) return;
  limits_ = limits;
  hold_s_ = limits.hold_s;
  latencies_ = {};
  drops_ = {};
  degraded_ = false;
  changed_ = {};
}

bool LoadControl::answered(double latency_s, Clock::TimePoint now) {
  const std::lock_guard lock(mutex_);
  latencies_.add(latency_s);
  drops_.add(0);
  return decide(now);
}

bool LoadControl::dropped(Clock::TimePoint now) {
  const std::lock_guard lock(mutex_);
  drops_.add(1);
  return decide(now);
}

bool LoadControl::degraded() const {
  const std::lock_guard lock(mutex_);
  return degraded_;
}

bool LoadControl::decide(Clock::TimePoint now) {
  if (!limits_.enabled) return false;
  if (!degraded_ && too_much()) {
    change(true, now);
    return true;
  }
  if (degraded_ && seconds(now - changed_) >= hold_s_ && room_for_more()) {
    change(false, now);
    return true;
  }
  return false;
}

bool LoadControl::too_much() const {
  return (latencies_.half_full() && latencies_.mean() > limits_.above_s) ||
         (drops_.half_full() && drops_.mean() > limits_.above_drop_share);
}

bool LoadControl::room_for_more() const {
  return latencies_.half_full() && latencies_.mean() < limits_.below_s && drops_.half_full() &&
         drops_.mean() <= 0.5 * limits_.above_drop_share;
}

void LoadControl::change(bool degraded, Clock::TimePoint now) {
  if (degraded) {
    const bool too_early = changed_ != Clock::TimePoint{} && seconds(now - changed_) < hold_s_;
    hold_s_ = too_early ? std::min(2 * hold_s_, kLongestHold * limits_.hold_s) : limits_.hold_s;
  }
  degraded_ = degraded;
  changed_ = now;
  latencies_ = {};
  drops_ = {};
}

}  // namespace graspd

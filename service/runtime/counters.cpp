// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/runtime/counters.hpp"

#include <algorithm>
#include <cmath>

namespace graspd {

void LatencyWindow::add(double seconds) {
  values_[count_++ % kSize] = seconds;
}

double LatencyWindow::percentile(double share) const {
  const std::size_t n = std::min(count_, kSize);
  if (n == 0) return 0;
  std::array<double, kSize> sorted = values_;
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(n)));
  const std::size_t index = std::clamp<std::size_t>(rank, 1, n) - 1;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(index),
                   sorted.begin() + static_cast<std::ptrdiff_t>(n));
  return sorted[index];
}

double RateMeter::update(std::int64_t total, Clock::TimePoint now) {
  const double elapsed = seconds(now - last_time_);
  const double rate = started_ && elapsed > 0 ? static_cast<double>(total - last_total_) / elapsed : 0;
  last_total_ = total;
  last_time_ = now;
  started_ = true;
  return rate;
}

void SequenceGaps::add(std::int64_t seq) {
  if (seq < 0) return;
  if (last_ >= 0 && seq > last_) {
    const auto missing = static_cast<std::uint64_t>(seq - last_) - 1;
    if (missing <= kLargestGap) lost_ += static_cast<std::int64_t>(missing);
  }
  last_ = seq;
}

}  // namespace graspd

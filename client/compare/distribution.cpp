// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/compare/distribution.hpp"

#include <algorithm>
#include <cmath>

namespace graspd {

void Distribution::add(double value) {
  if (!std::isfinite(value)) return;
  constexpr double kFarthest = 1e15;
  ++bins_[std::llround(std::clamp(value / step_, -kFarthest, kFarthest))];
  ++count_;
  sum_ += value;
}

double Distribution::mean() const {
  return count_ > 0 ? sum_ / static_cast<double>(count_) : 0;
}

double Distribution::quantile(double share) const {
  const double wanted = share * static_cast<double>(count_);
  std::int64_t below = 0;
  for (const auto& [bin, values] : bins_) {
    below += values;
    if (static_cast<double>(below) >= wanted) return static_cast<double>(bin) * step_;
  }
  return 0;
}

double shift_between(const Distribution& a, const Distribution& b) {
  if (a.count() == 0 || b.count() == 0) return 0;
  double largest = 0;
  std::int64_t below_a = 0, below_b = 0;
  auto x = a.bins().begin();
  auto y = b.bins().begin();
  while (x != a.bins().end() || y != b.bins().end()) {
    const bool take_x = y == b.bins().end() || (x != a.bins().end() && x->first <= y->first);
    const bool take_y = x == a.bins().end() || (y != b.bins().end() && y->first <= x->first);
    if (take_x) below_a += (x++)->second;
    if (take_y) below_b += (y++)->second;
    largest = std::max(largest, std::abs(static_cast<double>(below_a) / static_cast<double>(a.count()) -
                                         static_cast<double>(below_b) / static_cast<double>(b.count())));
  }
  return largest;
}

}  // namespace graspd

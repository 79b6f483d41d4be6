// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// How a quantity is distributed in two runs.
#pragma once
#include <cstdint>
#include <map>
#include <string>

namespace graspd {

/// Counts values by steps of a fixed size; takes memory for the steps that occur.
class Distribution {
 public:
  explicit Distribution(double step) : step_(step) {}

  void add(double value);
  [[nodiscard]] std::int64_t count() const { return count_; }
  [[nodiscard]] double mean() const;
  /// The value that `share` [0, 1] of the values do not exceed, to half a step; 0 without values.
  [[nodiscard]] double quantile(double share) const;
  [[nodiscard]] double step() const { return step_; }
  [[nodiscard]] const std::map<std::int64_t, std::int64_t>& bins() const { return bins_; }

 private:
  double step_;
  std::int64_t count_ = 0;
  double sum_ = 0;
  std::map<std::int64_t, std::int64_t> bins_;  // index of the step -> values
};

/// The largest difference between the two distribution functions [0, 1] (Kolmogorov and Smirnov); 0 where one
/// is empty.
[[nodiscard]] double shift_between(const Distribution& a, const Distribution& b);

}  // namespace graspd

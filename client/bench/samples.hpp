// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Times of one thing, measured again and again.
#pragma once
#include <vector>

namespace graspd {

/// All are 0 without values.
struct Samples {
  std::vector<double> values;

  void add(double value) { values.push_back(value); }
  /// The value that this share [0, 1] of the values stays below, linear between the two nearest.
  [[nodiscard]] double quantile(double share) const;
  [[nodiscard]] double median() const { return quantile(0.5); }
  [[nodiscard]] double min() const { return quantile(0); }
  [[nodiscard]] double max() const { return quantile(1); }
};

}  // namespace graspd

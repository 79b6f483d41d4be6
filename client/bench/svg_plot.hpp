// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// A plot of lines with logarithmic axes as an SVG picture that reads well on light and dark pages.
#pragma once
#include <string>
#include <utility>
#include <vector>

namespace graspd {

struct PlotLine {
  std::string label;
  int color = 0;  ///< 0 to 3
  bool dashed = false;
  std::vector<std::pair<double, double>> points;  ///< x ascending; both above 0
};

struct Plot {
  std::string title, x_label, y_label;
  std::vector<PlotLine> lines;
};

/// Throws std::invalid_argument when there is nothing to draw, or a value that has no logarithm.
[[nodiscard]] std::string svg(const Plot& plot);

/// Values 1, 2 and 5 times a power of ten from the largest that is not above low to the smallest that is not
/// below high, either by no more than 2 %.
[[nodiscard]] std::vector<double> log_ticks(double low, double high);

/// 20000 -> 20k.
[[nodiscard]] std::string tick_label(double value);

/// Moves places apart until each is min_gap from the next, and as near as may be to where it was; the order
/// stays.
[[nodiscard]] std::vector<double> spread(std::vector<double> places, double min_gap);

}  // namespace graspd

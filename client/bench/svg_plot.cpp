// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/bench/svg_plot.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "client/common/text.hpp"

namespace graspd {
namespace {

// Of the picture and of the plot's corners in it [pixels].
constexpr double kWidth = 780, kHeight = 460, kLeft = 70, kRight = 560, kTop = 56, kBottom = 396;
constexpr double kLabelGap = 19;
constexpr double kSlack = 0.02;  // by which a value may lie beyond the axis' end, less than a marker

constexpr const char* kStyle = R"(<style>
  text { font: 13px "Segoe UI", "Helvetica Neue", Arial, sans-serif; fill: #3d444d }
  .title { font-size: 16px; font-weight: 600; fill: #1f2328 }
  .grid { stroke: #d1d9e0; stroke-width: 1 }
  .frame { stroke: #818b98; stroke-width: 1; fill: none }
  .line { fill: none; stroke-width: 2.2; stroke-linejoin: round }
  .dashed { stroke-dasharray: 6 4 }
  .lead { stroke-width: 1; fill: none; opacity: 0.6 }
  .s0 { stroke: #0969da } .f0 { fill: #0969da } .s1 { stroke: #1a7f37 } .f1 { fill: #1a7f37 }
  .s2 { stroke: #bc4c00 } .f2 { fill: #bc4c00 } .s3 { stroke: #8250df } .f3 { fill: #8250df }
  @media (prefers-color-scheme: dark) {
    text { fill: #b7bdc8 } .title { fill: #f0f6fc } .grid { stroke: #30363d } .frame { stroke: #6e7681 }
    .s0 { stroke: #58a6ff } .f0 { fill: #58a6ff } .s1 { stroke: #3fb950 } .f1 { fill: #3fb950 }
    .s2 { stroke: #f0883e } .f2 { fill: #f0883e } .s3 { stroke: #bc8cff } .f3 { fill: #bc8cff }
  }
</style>
)";

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else
      out += c;
  }
  return out;
}

std::string text_at(double x, double y, const char* attributes, const std::string& text) {
  return printed("<text x=\"%.1f\" y=\"%.1f\" %s>%s</text>\n", x, y, attributes, escaped(text).c_str());
}

/// One axis: values to pixels.
struct Axis {
  double low = 1, high = 10, first_px = 0, last_px = 1;

  [[nodiscard]] double at(double value) const {
    return first_px + (last_px - first_px) * std::log(value / low) / std::log(high / low);
  }
};

struct Axes {
  Axis x, y;
  std::vector<double> x_ticks, y_ticks;
};

Axes axes_of(const Plot& plot) {
  double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {0, 0};
  for (const PlotLine& line : plot.lines)
    for (const auto& [x, y] : line.points) {
      const double value[2] = {x, y};
      for (int k = 0; k < 2; ++k) {
        if (!(value[k] > 0) || !std::isfinite(value[k]))
          throw std::invalid_argument("a plot with logarithmic axes needs values above 0");
        low[k] = std::min(low[k], value[k]);
        high[k] = std::max(high[k], value[k]);
      }
    }
  if (high[0] == 0) throw std::invalid_argument("a plot without points");
  Axes axes;
  axes.x_ticks = log_ticks(low[0], high[0]);
  axes.y_ticks = log_ticks(low[1], high[1]);
  axes.x = {axes.x_ticks.front(), axes.x_ticks.back(), kLeft, kRight};
  axes.y = {axes.y_ticks.front(), axes.y_ticks.back(), kBottom, kTop};
  return axes;
}

/// Whether a tick gets its label: all of few, else the powers of ten.
bool is_labelled(double tick, std::size_t num_ticks) {
  const double power = std::log10(tick);
  return num_ticks <= 10 || std::abs(power - std::round(power)) < 1e-9;
}

std::string grid(const Axes& axes) {
  std::string text;
  for (const double tick : axes.x_ticks) {
    const double x = axes.x.at(tick);
    text += printed("<path class=\"grid\" d=\"M%.1f %.1fV%.1f\"/>\n", x, kTop, kBottom);
    if (is_labelled(tick, axes.x_ticks.size()))
      text += text_at(x, kBottom + 20, "text-anchor=\"middle\"", tick_label(tick));
  }
  for (const double tick : axes.y_ticks) {
    const double y = axes.y.at(tick);
    text += printed("<path class=\"grid\" d=\"M%.1f %.1fH%.1f\"/>\n", kLeft, y, kRight);
    if (is_labelled(tick, axes.y_ticks.size()))
      text += text_at(kLeft - 8, y + 4.5, "text-anchor=\"end\"", tick_label(tick));
  }
  return text + printed("<rect class=\"frame\" x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\"/>\n",
                        kLeft, kTop, kRight - kLeft, kBottom - kTop);
}

std::string drawn(const PlotLine& line, const Axes& axes) {
  std::string path, markers;
  for (const auto& [x, y] : line.points) {
    const double px = axes.x.at(x), py = axes.y.at(y);
    path += printed("%c%.1f %.1f", path.empty() ? 'M' : 'L', px, py);
    markers += printed("<circle class=\"f%d\" cx=\"%.1f\" cy=\"%.1f\" r=\"3.2\"/>\n", line.color, px, py);
  }
  return printed("<path class=\"line s%d%s\" d=\"%s\"/>\n", line.color, line.dashed ? " dashed" : "",
                 path.c_str()) +
         markers;
}

/// Names at the lines' right ends, apart from each other.
std::string labels(const std::vector<PlotLine>& lines, const Axes& axes) {
  std::vector<double> ends;
  ends.reserve(lines.size());
  for (const PlotLine& line : lines) ends.push_back(axes.y.at(line.points.back().second));
  const std::vector<double> places = spread(ends, kLabelGap);
  std::string text;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    text += printed("<path class=\"lead s%d\" d=\"M%.1f %.1fL%.1f %.1f\"/>\n", lines[i].color,
                    axes.x.at(lines[i].points.back().first) + 5, ends[i], kRight + 22, places[i]);
    text += text_at(kRight + 26, places[i] + 4.5, "", lines[i].label);
  }
  return text;
}

}  // namespace

std::vector<double> log_ticks(double low, double high) {
  std::vector<double> ticks;
  for (int power = static_cast<int>(std::floor(std::log10(low))) - 1;; ++power)
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double tick = digit * std::pow(10.0, power);
      if (tick <= low * (1 + kSlack)) ticks.clear();  // a larger one begins the axis
      ticks.push_back(tick);
      if (tick >= high * (1 - kSlack) && ticks.size() > 1) return ticks;
    }
}

std::string tick_label(double value) {
  if (value >= 1e6) return printed("%gM", value * 1e-6);
  if (value >= 1e3) return printed("%gk", value * 1e-3);
  return printed("%g", value);
}

std::vector<double> spread(std::vector<double> places, double min_gap) {
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](auto i, auto j) { return places[i] < places[j]; });
  // Groups that would touch become one, in the middle of where its members want to be.
  struct Group {
    double middle;
    double count;
  };
  std::vector<Group> groups;
  for (const std::size_t i : order) {
    groups.push_back({places[i], 1});
    while (groups.size() > 1) {
      const Group last = groups.back();
      Group& before = groups[groups.size() - 2];
      if (last.middle - before.middle >= 0.5 * min_gap * (last.count + before.count)) break;
      const double count = before.count + last.count;
      before = {(before.middle * before.count + last.middle * last.count) / count, count};
      groups.pop_back();
    }
  }
  auto next = order.begin();
  for (const Group& group : groups)
    for (int k = 0; k < static_cast<int>(group.count); ++k)
      places[*next++] = group.middle + min_gap * (k - 0.5 * (group.count - 1));
  return places;
}

std::string svg(const Plot& plot) {
  std::vector<PlotLine> lines = plot.lines;
  std::erase_if(lines, [](const PlotLine& line) { return line.points.empty(); });
  const Axes axes = axes_of(plot);
  std::string text = printed(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" width=\"%.0f\" height=\"%.0f\">\n",
      kWidth, kHeight, kWidth, kHeight);
  text += printed("<title>%s</title>\n", escaped(plot.title).c_str()) + kStyle;
  text += text_at(kLeft, 32, "class=\"title\"", plot.title) + grid(axes);
  for (const PlotLine& line : lines) text += drawn(line, axes);
  text += labels(lines, axes);
  text += text_at(0.5 * (kLeft + kRight), kHeight - 18, "text-anchor=\"middle\"", plot.x_label);
  text += printed("<text transform=\"translate(20 %.1f) rotate(-90)\" text-anchor=\"middle\">%s</text>\n",
                  0.5 * (kTop + kBottom), escaped(plot.y_label).c_str());
  return text + "</svg>\n";
}

}  // namespace graspd

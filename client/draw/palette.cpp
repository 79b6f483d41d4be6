// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/draw/palette.hpp"

#include <algorithm>
#include <array>
#include <span>

namespace graspd {
namespace {

constexpr std::array<Color, 6> kSegments{
    {{119, 170, 221}, {238, 136, 102}, {68, 187, 153}, {255, 170, 187}, {153, 221, 255}, {204, 187, 221}}};
// Every eighth of matplotlib's tables.
constexpr std::array<Color, 9> kCividis{{{0, 34, 78},
                                         {29, 56, 109},
                                         {67, 78, 108},
                                         {97, 101, 111},
                                         {125, 124, 120},
                                         {155, 148, 118},
                                         {187, 173, 108},
                                         {221, 201, 89},
                                         {254, 232, 56}}};
constexpr std::array<Color, 9> kViridis{{{68, 1, 84},
                                         {71, 44, 122},
                                         {59, 81, 139},
                                         {44, 113, 142},
                                         {33, 144, 141},
                                         {39, 173, 129},
                                         {92, 200, 99},
                                         {170, 220, 50},
                                         {253, 231, 37}}};

Color on_ramp(std::span<const Color> ramp, double value) {
  const double last = static_cast<double>(ramp.size() - 1);
  const double place = value > 0 ? std::min(1.0, value) * last : 0;  // a NaN is at the beginning
  const auto i = std::min(static_cast<std::size_t>(place), ramp.size() - 2);
  return mixed(ramp[i], ramp[i + 1], static_cast<float>(place - static_cast<double>(i)));
}

}  // namespace

Color segment_color(int segment) {
  return kSegments[static_cast<std::size_t>(std::max(segment, 0)) % kSegments.size()];
}

Color score_color(double score) {
  return on_ramp(kCividis, score);
}

Color depth_color(double share) {
  return on_ramp(kViridis, share);
}

}  // namespace graspd

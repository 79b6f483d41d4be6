// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/draw/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace graspd {
namespace {

constexpr float kNothing = -std::numeric_limits<float>::infinity();
constexpr float kFarAway = 1e6f;  // more pixels than any picture has
constexpr Color kDark{25, 25, 30};
constexpr float kNoise = 0.006f;  // of a depth camera at 1 m, growing with the square of the depth [1/m]

/// Twice the area of the triangle, positive for one sense of rotation.
float cross(const Projected& a, const Projected& b, float u, float v) {
  return (b.u - a.u) * (v - a.v) - (b.v - a.v) * (u - a.u);
}

int whole(float value) {
  return static_cast<int>(std::clamp(value, -kFarAway, kFarAway));
}

}  // namespace

Canvas::Canvas(int width, int height, Color background)
    : image_(width, height, background),
      nearness_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), kNothing) {}

void Canvas::splat(const Projected& place, float side, Color color) {
  const float half = 0.5f * std::max(side, 1.0f);
  const Area area = clipped(place.u - half, place.u + half, place.v - half, place.v + half);
  for (int y = area.top; y < area.bottom; ++y)
    for (int x = area.left; x < area.right; ++x) put(x, y, place.nearness, color);
}

void Canvas::triangle(const std::array<Projected, 3>& corners, Color color) {
  const auto& [a, b, c] = corners;
  const float twice_area = cross(a, b, c.u, c.v);
  if (!(std::abs(twice_area) > 1e-6f)) return;
  const Area area = clipped(std::min({a.u, b.u, c.u}), std::max({a.u, b.u, c.u}), std::min({a.v, b.v, c.v}),
                            std::max({a.v, b.v, c.v}) + 1);
  for (int y = area.top; y < area.bottom; ++y) {
    for (int x = area.left; x < area.right; ++x) {
      const float u = static_cast<float>(x) + 0.5f, v = static_cast<float>(y) + 0.5f;
      const float of_a = cross(b, c, u, v) / twice_area, of_b = cross(c, a, u, v) / twice_area;
      const float of_c = 1 - of_a - of_b;
      if (of_a < 0 || of_b < 0 || of_c < 0) continue;
      put(x, y, of_a * a.nearness + of_b * b.nearness + of_c * c.nearness, color);
    }
  }
}

void Canvas::line(const Projected& from, const Projected& to, float width, Color color) {
  const float length = std::hypot(to.u - from.u, to.v - from.v);
  if (!(length < kFarAway)) return;
  const int steps = whole(std::ceil(2 * length)) + 1;
  for (int i = 0; i <= steps; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(steps);
    splat({from.u + t * (to.u - from.u), from.v + t * (to.v - from.v),
           from.nearness + t * (to.nearness - from.nearness)},
          width, color);
  }
}

void Canvas::shade_depth(const Projection& projection, float strength) {
  constexpr int kReach = 2;  // pixels
  const Image before = image_;
  const int w = image_.width(), h = image_.height();
  const auto depth = [&](int x, int y) {
    const float nearness =
        nearness_[static_cast<std::size_t>(y) * static_cast<std::size_t>(w) + static_cast<std::size_t>(x)];
    return nearness == kNothing ? 0 : projection.depth_of(nearness);
  };
  for (int y = kReach; y < h - kReach; ++y) {
    for (int x = kReach; x < w - kReach; ++x) {
      const float own = depth(x, y);
      if (own == 0) continue;
      float nearer = 0;
      for (const auto& [dx, dy] : {std::pair{kReach, 0}, {-kReach, 0}, {0, kReach}, {0, -kReach}}) {
        const float other = depth(x + dx, y + dy);
        if (other != 0) nearer += std::clamp(own - other - kNoise * own * own, 0.0f, 0.05f);
      }
      image_.at(x, y) = mixed(kDark, before.at(x, y), std::exp(-12 * strength * nearer));
    }
  }
}

Image Canvas::halved() const {
  Image half(image_.width() / 2, image_.height() / 2, {});
  for (int y = 0; y < half.height(); ++y) {
    for (int x = 0; x < half.width(); ++x) {
      int r = 2, g = 2, b = 2;  // rounds
      for (const auto& [dx, dy] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
        const Color c = image_.at(2 * x + dx, 2 * y + dy);
        r += c.r, g += c.g, b += c.b;
      }
      half.at(x, y) = {static_cast<std::uint8_t>(r / 4), static_cast<std::uint8_t>(g / 4),
                       static_cast<std::uint8_t>(b / 4)};
    }
  }
  return half;
}

Canvas::Area Canvas::clipped(float left, float right, float top, float bottom) const {
  return {std::clamp(whole(std::round(left)), 0, image_.width()),
          std::clamp(whole(std::round(right)), 0, image_.width()),
          std::clamp(whole(std::round(top)), 0, image_.height()),
          std::clamp(whole(std::round(bottom)), 0, image_.height())};
}

void Canvas::put(int x, int y, float nearness, Color color) {
  float& known = nearness_[static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width()) +
                           static_cast<std::size_t>(x)];
  if (!(nearness > known)) return;
  known = nearness;
  image_.at(x, y) = color;
}

}  // namespace graspd

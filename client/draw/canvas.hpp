// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Draws points, boxes and lines in the right order of depth.
#pragma once
#include <array>
#include <vector>

#include "client/draw/image.hpp"
#include "client/draw/projection.hpp"

namespace graspd {

/// A software renderer: needs no display, no graphics driver and no Mesa, and makes the same picture
/// everywhere.
class Canvas {
 public:
  Canvas(int width, int height, Color background);

  /// A square with this side around the place.
  void splat(const Projected& place, float side, Color color);
  void triangle(const std::array<Projected, 3>& corners, Color color);
  /// A line of this width.
  void line(const Projected& from, const Projected& to, float width, Color color);

  /// Darkens what has something nearer beside it, so that shapes can be seen without normals (eye-dome
  /// lighting). strength 1: visibly.
  void shade_depth(const Projection& projection, float strength);

  /// Half as wide and high, each pixel the mean of four: smooth borders.
  [[nodiscard]] Image halved() const;

 private:
  struct Area {
    int left, right, top, bottom;  // right and bottom are outside
  };
  [[nodiscard]] Area clipped(float left, float right, float top, float bottom) const;
  void put(int x, int y, float nearness, Color color);

  Image image_;
  std::vector<float> nearness_;
};

}  // namespace graspd

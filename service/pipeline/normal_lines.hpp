// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Where lines along the normals of walls meet, seen along an axis: those of a body of revolution meet on it.
#pragma once
#include <Eigen/Core>
#include <optional>
#include <span>

namespace graspd {

/// Across an axis: a place on a wall [m] and its normal there, unit length.
struct NormalLine {
  Eigen::Vector2f p, normal;

  /// How far the line passes a place, signed [m].
  [[nodiscard]] float passes(const Eigen::Vector2f& place) const {
    return normal.x() * (p - place).y() - normal.y() * (p - place).x();
  }
};

/// Least squares of how far the lines pass it, reweighted by Cauchy weights of this scale. Nothing where they
/// are too parallel to tell: then they are normals of less than about a quarter of a circle.
[[nodiscard]] std::optional<Eigen::Vector2f> meeting_point(std::span<const NormalLine> lines, float scale_m);

}  // namespace graspd

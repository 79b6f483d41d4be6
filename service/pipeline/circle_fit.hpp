// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// A circle through the profile of what is between the jaws: how a round object goes on where it is not seen.
#pragma once
#include <Eigen/Core>
#include <optional>
#include <span>

namespace graspd {

struct Circle {
  Eigen::Vector2f center = Eigen::Vector2f::Zero();  ///< [m]
  float radius = 0;                                  ///< [m]
};

/// One of how many points is enough: a spread sample says the same.
[[nodiscard]] constexpr std::size_t circle_step(std::size_t num_points) {
  constexpr std::size_t kEnough = 160;
  return (num_points + kEnough - 1) / kEnough;
}

/// Least squares in the algebraic distance (Kasa), reweighted by Cauchy weights with a scale of 2 mm. Nothing
/// where fewer than 12 points are given, where the circle does not pass within the tolerance of 85 % of them,
/// or where these see less than a sixth of it: then the points do not tell a circle from something else.
[[nodiscard]] std::optional<Circle> fit_circle(std::span<const Eigen::Vector2f> points, float max_radius_m,
                                               float tolerance_m);

}  // namespace graspd

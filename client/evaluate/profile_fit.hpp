// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Planes and circles through few, noisy points.
#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

namespace graspd {

[[nodiscard]] std::vector<Eigen::Vector3f> neighbors(const std::vector<Eigen::Vector3f>& points,
                                                     const Eigen::Vector3f& p, float radius_m);

/// Smallest principal axis, towards the viewpoint; nothing for fewer than six points.
[[nodiscard]] std::optional<Eigen::Vector3f> plane_normal(const std::vector<Eigen::Vector3f>& points,
                                                          const Eigen::Vector3f& viewpoint);

/// In the plane of closing axis and approach.
struct Circle {
  float y = 0, z = 0;
  float radius = 0;
};

/// A circle that the points, projected along x, lie on within their noise and with a bulge towards -z;
/// nothing when they are flat, or too scattered to tell.
[[nodiscard]] std::optional<Circle> fit_circle(const std::vector<Eigen::Vector3f>& points);

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Clouds for tests: random ones, simple surfaces, and changes that must not matter to whoever reads them.
#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <functional>

#include "service/pipeline/point_cloud.hpp"

namespace graspd {

/// n points spread evenly over a box.
[[nodiscard]] PointCloud random_cloud(std::size_t n, const Eigen::Vector3f& min, const Eigen::Vector3f& max,
                                      std::uint32_t seed);

/// Regular grid corner + i u + j v, row by row.
[[nodiscard]] PointCloud grid_patch(const Eigen::Vector3f& corner, const Eigen::Vector3f& u,
                                    const Eigen::Vector3f& v, int nu, int nv);

/// n points spread over a sphere (golden spiral), about sqrt(4 pi / n) radii apart.
[[nodiscard]] PointCloud sphere_shell(const Eigen::Vector3f& center, float radius_m, std::size_t n);

/// The six faces of a box with edges along the axes, sampled every spacing.
[[nodiscard]] PointCloud box_shell(const Eigen::Vector3f& min, const Eigen::Vector3f& max, float spacing_m);

/// b after a, unorganized, seen from where a was.
[[nodiscard]] PointCloud joined(const PointCloud& a, const PointCloud& b);

[[nodiscard]] PointCloud shuffled(const PointCloud& cloud, std::uint32_t seed);
/// Viewpoint too.
[[nodiscard]] PointCloud moved(const PointCloud& cloud, const Eigen::Isometry3f& T);
/// Finite points alone, unorganized.
[[nodiscard]] PointCloud finite_points(const PointCloud& cloud);
/// Every point twice, the copies at the end.
[[nodiscard]] PointCloud doubled(const PointCloud& cloud);
/// Missing points between the others: one after every every-th.
[[nodiscard]] PointCloud with_missing_between(const PointCloud& cloud, std::size_t every);
/// Moved along the lines of sight, normally distributed with this deviation.
[[nodiscard]] PointCloud with_range_noise(const PointCloud& cloud, float sigma_m, std::uint32_t seed);
/// With one that depends on the distance from the sensor [m].
[[nodiscard]] PointCloud with_range_noise(const PointCloud& cloud,
                                          const std::function<float(float range_m)>& sigma_m,
                                          std::uint32_t seed);

}  // namespace graspd

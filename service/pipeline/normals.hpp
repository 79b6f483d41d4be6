// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Surface normals: the smallest principal axis of each neighbourhood, towards the sensor.
#pragma once
#include <memory_resource>
#include <vector>

#include "service/pipeline/neighborhoods.hpp"
#include "service/pipeline/point_cloud.hpp"
#include "service/pipeline/point_kernels.hpp"

namespace graspd {

/// Unit vectors as a structure of arrays; zero where a neighbourhood has fewer than three points or no plane.
struct Normals {
  std::pmr::vector<float> x, y, z;

  Normals() = default;
  Normals(std::size_t n, const Eigen::Vector3f& all) : x(n, all.x()), y(n, all.y()), z(n, all.z()) {}

  [[nodiscard]] std::size_t size() const { return x.size(); }
  [[nodiscard]] NormalArrays arrays() const { return {x.data(), y.data(), z.data()}; }
  [[nodiscard]] Eigen::Vector3f at(std::size_t i) const { return {x[i], y[i], z[i]}; }
};

/// others: what skipped points have for a normal.
[[nodiscard]] Normals estimate_normals(const PointCloud& cloud, const Neighborhoods& neighborhoods,
                                       const Eigen::Vector3f& others = Eigen::Vector3f::Zero());
/// The normals of points that are not skipped; the others stay what they are.
void estimate_normals(const PointCloud& cloud, const Neighborhoods& neighborhoods, Normals& normals);

}  // namespace graspd

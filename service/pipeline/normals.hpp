// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Surface normals: the smallest principal axis of each neighbourhood, towards the sensor.
#pragma once
#include <memory_resource>
#include <vector>

#include "service/pipeline/neighborhoods.hpp"
#include "service/pipeline/point_cloud.hpp"

namespace graspd {

/// Unit vectors as a structure of arrays; zero where a neighbourhood has fewer than three points, is skipped,
/// or has no plane.
struct Normals {
  std::pmr::vector<float> x, y, z;

  [[nodiscard]] std::size_t size() const { return x.size(); }
  [[nodiscard]] Eigen::Vector3f at(std::size_t i) const { return {x[i], y[i], z[i]}; }
};

[[nodiscard]] Normals estimate_normals(const PointCloud& cloud, const Neighborhoods& neighborhoods);

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/thin_wall.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace graspd {

WallShape fit_wall(const LocalPoints& local, const std::pmr::vector<std::uint32_t>& between, float top_m,
                   const Gripper& gripper) {
  constexpr float kEdge = 0.004f;      // below the top, where points are of the edge itself [m]
  constexpr float kRidge = 1e-4f;      // on the scaled normal equations
  constexpr float kMinLength = 1e-3f;  // along the approach [m]
  using Row = Eigen::Matrix<float, 5, 1>;
  const float from = top_m + kEdge, length = std::max(kMinLength, gripper.grasp_depth_m - from),
              width = gripper.finger_thickness_m;
  Eigen::Matrix<float, 5, 5> A = kRidge * Eigen::Matrix<float, 5, 5>::Identity();
  Row b = Row::Zero();
  for (const std::uint32_t k : between) {
    const float z = (local.z[k] - from) / length - 0.5f, a = local.a[k] / width;
    if (std::abs(z) > 0.5f) continue;
    const Row row{1, a, a * a, z, z * z};
    A += row * row.transpose();
    b += row * local.f[k];
  }
  const Row c = A.ldlt().solve(b);
  return {Eigen::Vector3f(-c[1] / width, 1, -c[3] / length).normalized(), 0.25f * std::abs(c[4])};
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The shape of a thin wall between the jaws, of which one face is seen.
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "service/pipeline/box_query.hpp"
#include "service/pipeline/gripper.hpp"

namespace graspd {

struct WallShape {
  Eigen::Vector3f normal;  ///< of its middle, in gripper coordinates, unit length, towards +y
  float bend_m;            ///< how far its middle is off the line between its ends, along the approach
};

/// Least squares of f = c0 + c1 a + c2 a^2 + c3 z + c4 z^2 over the points from below the wall's edge to the
/// fingertips: more than the mean of the points' normals, which smoothing pulls towards the edge, it tells
/// how the jaws would meet the wall. between: positions in local of the object's points between the jaws;
/// top_m: their smallest depth. Fewer than five points leave what they do not tell at 0.
[[nodiscard]] WallShape fit_wall(const LocalPoints& local, const std::pmr::vector<std::uint32_t>& between,
                                 float top_m, const Gripper& gripper);

}  // namespace graspd

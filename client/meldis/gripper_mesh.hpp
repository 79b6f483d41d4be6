// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The gripper of a handle as triangles: two fingers closed on the object, and the palm behind them.
#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "graspd/gripper_t.hpp"
#include "graspd/handle_t.hpp"

namespace graspd {

struct TriangleMesh {
  std::vector<Eigen::Vector3f> vertices;      ///< [m]
  std::vector<std::array<int, 3>> triangles;  ///< of vertices, counter-clockwise from outside
};

/// Adds the three boxes of a gripper that holds at the handle, in the handle's frame.
void add_gripper(TriangleMesh& mesh, const handle_t& handle, const gripper_t& gripper);

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Small scenes of true solids, and handles on them.
#pragma once
#include "client/simulate/scene.hpp"
#include "service/pipeline/handle.hpp"

namespace graspd {

/// A table whose surface is z = 0, labelled as support.
[[nodiscard]] Scene bare_table();

/// Adds a body with the next object's label; position and turn about the vertical in the world.
void add_body(Scene& scene, const Convex& part, const Eigen::Vector3d& position, double yaw_rad = 0);

/// A gripper pose: position, approach, and the closing axis as far as it is across the approach.
[[nodiscard]] Handle handle_at(const Eigen::Vector3d& position, const Eigen::Vector3d& approach,
                               const Eigen::Vector3d& closing, double width_m);

/// From straight above, the fingertips at tip_z, closing along x.
[[nodiscard]] Handle handle_from_above(double x, double y, double tip_z, double width_m);

}  // namespace graspd

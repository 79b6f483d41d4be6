// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Lowers an object at any tilt until it meets what is there: for objects that lean on others.
#pragma once
#include <optional>

#include "client/simulate/scene.hpp"

namespace graspd {

/// Whether two solids have matter in common, deeper than 0.4 mm; by less they may have.
[[nodiscard]] bool overlap(const Solid& a, const Solid& b);

/// The object's pose after it was lowered straight down from its own, by drop_m at most, to its first contact
/// with the scene; never inside anything. Nothing when it is not free where it starts.
[[nodiscard]] std::optional<Eigen::Isometry3d> lowered(const Scene& scene, const Solid& object,
                                                       double drop_m);

}  // namespace graspd

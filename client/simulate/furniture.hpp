// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What objects stand on besides a single table: surfaces at several heights, and what walls them in.
#pragma once
#include <cstdint>

#include "client/simulate/placement.hpp"

namespace graspd {

/// A box that is part of the scene and no object.
[[nodiscard]] Solid slab(const char* kind, std::uint32_t label, std::uint32_t rgb,
                         const Eigen::Vector3d& center, const Eigen::Vector3d& half);

/// Apart, touching or on top of one another; nothing leans.
void add_loose_objects(ObjectMaker make, int num_objects, Scene& scene, Ground& ground, Rng& rng);

/// A block on the ground, 5 to 25 cm high and too wide to be held, and everyday objects on both.
void add_levels(int num_objects, Scene& scene, Ground& ground, Rng& rng);

/// Two boards between a back and two sides, and everyday objects on both.
void add_shelf(int num_objects, Scene& scene, Rng& rng);

}  // namespace graspd

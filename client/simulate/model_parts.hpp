// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What models of objects are put together from.
#pragma once
#include "client/simulate/object_models.hpp"

namespace graspd {

/// Of a random colour, without a footprint.
[[nodiscard]] ObjectModel with_part(const char* kind, Rng& rng, const Convex& part);

/// Around the origin, from the ground up to a height [m].
[[nodiscard]] Footprint circle(double radius, double height);
[[nodiscard]] Footprint rectangle(const Eigen::Vector2d& center, const Eigen::Vector2d& half, double height);

/// Lays an object that was made along z on its side: its axis along the world's x and at a height, what was
/// at z = middle over the origin [m].
void lay_down(ObjectModel& model, double middle, double height);

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Tools, fruit and other things that are neither boxes nor upright rounds: long, bent, put together.
#pragma once
#include "client/simulate/object_models.hpp"

namespace graspd {

/// Lying on its handle, the blade in the air.
[[nodiscard]] ObjectModel make_screwdriver(Rng& rng);
/// Lying on its head.
[[nodiscard]] ObjectModel make_hammer(Rng& rng);
/// Lying, bent in the plane of the ground.
[[nodiscard]] ObjectModel make_banana(Rng& rng);
/// A filled cup on a stem on a foot.
[[nodiscard]] ObjectModel make_goblet(Rng& rng);
[[nodiscard]] ObjectModel make_pan(Rng& rng);
/// Two plates at a right angle, one of them on the ground.
[[nodiscard]] ObjectModel make_bracket(Rng& rng);
/// Lying: a torus of straight pieces.
[[nodiscard]] ObjectModel make_ring(Rng& rng);
/// Lying: two discs and a bar between them.
[[nodiscard]] ObjectModel make_dumbbell(Rng& rng);

/// One of them.
[[nodiscard]] ObjectModel make_household_object(Rng& rng);

}  // namespace graspd

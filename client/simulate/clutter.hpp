// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What a cluttered scene is made of, from a few things apart to the paper's bin.
#pragma once
#include "client/simulate/placement.hpp"

namespace graspd {

struct ClutterConfig {
  int num_groups = 0;  ///< rows and piles of books and boxes
  double dropped = 0;  ///< share of the single objects that fell on the others at some tilt [0, 1]
  Crowding crowding;   ///< of the other single objects
};

[[nodiscard]] ClutterConfig easy_clutter();
[[nodiscard]] ClutterConfig medium_clutter();
[[nodiscard]] ClutterConfig hard_clutter();
[[nodiscard]] ClutterConfig extreme_clutter();

/// Groups first, then single objects until there are as many as wanted, as far as they find
/// a place.
void add_clutter(const ClutterConfig& config, int wanted, Scene& scene, Ground& ground, Rng& rng);

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The things that stand on simulated tables, each with random proportions in everyday sizes.
#pragma once
#include <optional>
#include <vector>

#include "client/simulate/footprint.hpp"
#include "client/simulate/rng.hpp"
#include "client/simulate/scene.hpp"

namespace graspd {

/// An object at rest on z = 0 with its middle over the origin.
struct ObjectModel {
  Solid solid;                        ///< label not yet given
  std::vector<Footprint> footprints;  ///< together cover the object
  /// Half sizes of a flat top that can carry another object, and its height.
  std::optional<Eigen::Vector2d> top_half;
  double top_z = 0;
  Eigen::Vector2d top_center = Eigen::Vector2d::Zero();
};

using ObjectMaker = ObjectModel (*)(Rng&);

[[nodiscard]] ObjectModel make_box(Rng& rng);
[[nodiscard]] ObjectModel make_book(Rng& rng);
[[nodiscard]] ObjectModel make_can(Rng& rng);
[[nodiscard]] ObjectModel make_lying_can(Rng& rng);
[[nodiscard]] ObjectModel make_bottle(Rng& rng);
[[nodiscard]] ObjectModel make_ball(Rng& rng);
[[nodiscard]] ObjectModel make_bowl(Rng& rng);
[[nodiscard]] ObjectModel make_mug(Rng& rng);
[[nodiscard]] ObjectModel make_cup(Rng& rng);
[[nodiscard]] ObjectModel make_jar(Rng& rng);
[[nodiscard]] ObjectModel make_lying_bottle(Rng& rng);
[[nodiscard]] ObjectModel make_pen(Rng& rng);
[[nodiscard]] ObjectModel make_small_block(Rng& rng);
[[nodiscard]] ObjectModel make_standing_book(Rng& rng);

/// The first eight of the above, common things more often.
[[nodiscard]] ObjectModel make_random_object(Rng& rng);

}  // namespace graspd

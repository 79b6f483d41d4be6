// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Finds places for objects on a table or in a bin: apart, pushed against others, on top of others.
#pragma once
#include <optional>
#include <vector>

#include "client/simulate/footprint.hpp"
#include "client/simulate/object_models.hpp"
#include "client/simulate/rng.hpp"
#include "client/simulate/scene.hpp"

namespace graspd {

inline constexpr double kTouchGap = 0.0005;  ///< room for rounding between objects that touch [m]

/// An object at its place.
struct Placed {
  std::vector<Footprint> footprints;
  std::optional<Footprint> top;  ///< free flat top; its z_min is the height
};

/// Where objects may be, and what is there already.
struct Ground {
  Eigen::Vector2d half;    ///< of the area that objects must stay in, around the origin
  Eigen::Vector2d spread;  ///< deviation of their places from the middle; 0: all over the area
  std::vector<Footprint> obstacles;
  std::vector<Placed> placed;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< of these and of places, in the world
  bool walled = false;  ///< the obstacles alone hold things in: they may be pushed against the walls
};

struct Place {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double yaw_rad = 0;
  double z = 0;
};

/// Shares of the objects [0, 1].
struct Crowding {
  double touching = 0.4;  ///< that are pushed against others
  double stacked = 0.2;   ///< that are put on top of others where that fits
};

/// A free place; nothing where none is found.
[[nodiscard]] std::optional<Place> find_place(const Crowding& crowding, const Ground& ground,
                                              const ObjectModel& model, Rng& rng);

/// Adds the object to the scene, with the next label.
void put(Scene& scene, Ground& ground, ObjectModel model, const Place& place);

/// Objects that keep their places to each other, in a bin about along its walls. False, and nothing happens,
/// where there is no place for all of them.
bool put_group(Scene& scene, Ground& ground, const std::vector<ObjectModel>& group, Rng& rng);

/// How many solids of a scene are objects.
[[nodiscard]] int num_objects(const Scene& scene);

}  // namespace graspd

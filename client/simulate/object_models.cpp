// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/simulate/object_models.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "client/simulate/model_parts.hpp"

namespace graspd {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;

ObjectModel block(const char* kind, Rng& rng, const Vector3d& half) {
  ObjectModel model = with_part(kind, rng, Box{{0, 0, half.z()}, half});
  model.footprints.push_back(rectangle(Vector2d::Zero(), half.head<2>(), 2 * half.z()));
  model.top_half = half.head<2>();
  model.top_z = 2 * half.z();
  return model;
}

/// An upright cylinder, open at the top.
ObjectModel vessel(const char* kind, Rng& rng, double radius, double height, double wall) {
  ObjectModel model = with_part(kind, rng, Cylinder{radius, 0, height});
  model.solid.cavity = Cylinder{radius - wall, wall, 2 * height};
  model.footprints.push_back(circle(radius, height));
  return model;
}

/// Half a ring of capsules in the plane y = 0, both ends in the wall of the mug.
void add_mug_handle(ObjectModel& mug, double wall_x, double middle_z, double ring_radius, double thickness) {
  constexpr int kPieces = 8;
  const auto at = [&](int i) {
    const double angle = pi * (static_cast<double>(i) / kPieces - 0.5);
    return Vector3d(wall_x + ring_radius * std::cos(angle), 0, middle_z + ring_radius * std::sin(angle));
  };
  for (int i = 0; i < kPieces; ++i) mug.solid.parts.emplace_back(Capsule{at(i), at(i + 1), thickness});
  const double reach = ring_radius + thickness;
  Footprint f = rectangle({wall_x + reach / 2, 0}, {reach / 2, thickness}, middle_z + reach);
  f.z_min = middle_z - reach;
  mug.footprints.push_back(f);
}

}  // namespace

ObjectModel make_box(Rng& rng) {
  std::array<double, 3> size{rng.uniform(0.025, 0.075), rng.uniform(0.045, 0.12), rng.uniform(0.07, 0.20)};
  // Standing on a long edge is rare on real tables: lie on the largest face, on the middle one, or stand.
  const int pose = rng.index(3);
  if (pose == 0) std::swap(size[0], size[2]);
  if (pose == 1) std::swap(size[1], size[2]);
  return block("box", rng, Vector3d(size[0], size[1], size[2]) / 2);
}

ObjectModel make_book(Rng& rng) {
  const double width = rng.uniform(0.10, 0.16);
  return block("book", rng, Vector3d(width, width * rng.uniform(1.3, 1.5), rng.uniform(0.012, 0.045)) / 2);
}

ObjectModel make_can(Rng& rng) {
  const double radius = rng.uniform(0.020, 0.042);
  const double height = rng.uniform(2.2, 4.2) * radius;
  ObjectModel model = with_part("can", rng, Cylinder{radius, 0, height});
  model.footprints.push_back(circle(radius, height));
  return model;
}

ObjectModel make_lying_can(Rng& rng) {
  const double radius = rng.uniform(0.018, 0.038);
  const double length = rng.uniform(2.5, 6.0) * radius;
  ObjectModel model = with_part("lying_can", rng, Cylinder{radius, -length / 2, length / 2});
  lay_down(model, 0, radius);
  model.footprints.push_back(rectangle(Vector2d::Zero(), {length / 2, radius}, 2 * radius));
  return model;
}

ObjectModel make_bottle(Rng& rng) {
  const double radius = rng.uniform(0.027, 0.040);
  const double shoulder = rng.uniform(3.0, 4.5) * radius;
  const double height = shoulder + rng.uniform(1.8, 2.4) * radius;
  ObjectModel model = with_part("bottle", rng, Cylinder{radius, 0, shoulder});
  model.solid.parts.emplace_back(Ball{{0, 0, shoulder}, radius});
  model.solid.parts.emplace_back(Cylinder{0.4 * radius, shoulder, height});
  model.footprints.push_back(circle(radius, height));
  return model;
}

ObjectModel make_ball(Rng& rng) {
  const double radius = rng.uniform(0.022, 0.048);
  ObjectModel model = with_part("ball", rng, Ball{{0, 0, radius}, radius});
  model.footprints.push_back(circle(radius, 2 * radius));
  return model;
}

ObjectModel make_bowl(Rng& rng) {
  const double radius = rng.uniform(0.055, 0.085);
  const double wall = rng.uniform(0.004, 0.007);
  // The foot is cut flat within the thickness of the wall, so that the bowl stands and holds.
  const double foot = radius - 0.4 * wall;
  ObjectModel model = with_part("bowl", rng, BallSlice{radius, -foot, 0});
  model.solid.cavity = Ball{Vector3d::Zero(), radius - wall};
  model.solid.T_world_solid.translation() = Vector3d(0, 0, foot);
  model.footprints.push_back(circle(radius, foot));
  return model;
}

ObjectModel make_mug(Rng& rng) {
  const double radius = rng.uniform(0.035, 0.045);
  const double height = rng.uniform(0.08, 0.11);
  const double wall = rng.uniform(0.004, 0.006);
  ObjectModel model = vessel("mug", rng, radius, height, wall);
  add_mug_handle(model, radius - wall / 2, height / 2, 0.28 * height, rng.uniform(0.004, 0.006));
  return model;
}

ObjectModel make_cup(Rng& rng) {
  const double radius = rng.uniform(0.030, 0.042);
  const double height = rng.uniform(1.8, 2.8) * radius;
  const double wall = rng.uniform(0.003, 0.005);
  return vessel("cup", rng, radius, height, wall);
}

ObjectModel make_jar(Rng& rng) {
  const double radius = rng.uniform(0.024, 0.040);
  const double shoulder = rng.uniform(1.8, 3.2) * radius;
  const double lid = rng.uniform(0.012, 0.022);
  ObjectModel model = with_part("jar", rng, Cylinder{radius, 0, shoulder});
  model.solid.parts.emplace_back(Cylinder{rng.uniform(0.75, 0.95) * radius, shoulder, shoulder + lid});
  model.footprints.push_back(circle(radius, shoulder + lid));
  return model;
}

ObjectModel make_lying_bottle(Rng& rng) {
  ObjectModel model = make_bottle(rng);
  model.solid.kind = "lying_bottle";
  const Footprint standing = model.footprints.front();
  const double middle = standing.z_max / 2;
  lay_down(model, middle, standing.radius);
  model.footprints = {rectangle(Vector2d::Zero(), {middle, standing.radius}, 2 * standing.radius)};
  return model;
}

ObjectModel make_pen(Rng& rng) {
  const double radius = rng.uniform(0.005, 0.009);
  const double length = rng.uniform(0.11, 0.17);
  ObjectModel model = with_part("pen", rng, Cylinder{radius, -length / 2, length / 2});
  lay_down(model, 0, radius);
  model.footprints.push_back(rectangle(Vector2d::Zero(), {length / 2, radius}, 2 * radius));
  return model;
}

ObjectModel make_small_block(Rng& rng) {
  return block("small_block", rng,
               Vector3d(rng.uniform(0.02, 0.05), rng.uniform(0.03, 0.07), rng.uniform(0.015, 0.045)) / 2);
}

ObjectModel make_standing_book(Rng& rng) {
  const double depth = rng.uniform(0.10, 0.16);
  return block("standing_book", rng,
               Vector3d(rng.uniform(0.012, 0.045), depth, depth * rng.uniform(1.0, 1.4)) / 2);
}

ObjectModel make_random_object(Rng& rng) {
  constexpr std::array<ObjectMaker, 12> kMakers{make_box,  make_box,       make_box,    make_can,
                                                make_can,  make_lying_can, make_bottle, make_ball,
                                                make_bowl, make_mug,       make_mug,    make_book};
  return rng.pick(kMakers)(rng);
}

}  // namespace graspd

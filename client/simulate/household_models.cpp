// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/simulate/household_models.hpp"

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

/// Capsules along an arc in a plane z = height, its middle over the origin; ends: angles from +y.
void add_arc(ObjectModel& model, double arc_radius, double from, double to, double height, double thickness) {
  constexpr int kPieces = 12;
  const auto at = [&](int i) {
    const double angle = from + (to - from) * static_cast<double>(i) / kPieces;
    return Vector3d(arc_radius * std::sin(angle), arc_radius * std::cos(angle), height);
  };
  for (int i = 0; i < kPieces; ++i) model.solid.parts.emplace_back(Capsule{at(i), at(i + 1), thickness});
}

}  // namespace

ObjectModel make_screwdriver(Rng& rng) {
  const double radius = rng.uniform(0.010, 0.017), grip = rng.uniform(0.08, 0.11);
  const double blade = rng.uniform(0.06, 0.13), blade_radius = rng.uniform(0.003, 0.004);
  ObjectModel model = with_part("screwdriver", rng, Cylinder{radius, 0, grip});
  model.solid.parts.emplace_back(Cylinder{blade_radius, grip, grip + blade});
  const double half = (grip + blade) / 2;
  lay_down(model, half, radius);
  model.footprints.push_back(rectangle(Vector2d::Zero(), {half, radius}, 2 * radius));
  return model;
}

ObjectModel make_hammer(Rng& rng) {
  const double head_radius = rng.uniform(0.014, 0.019), head = rng.uniform(0.08, 0.11);
  const double radius = rng.uniform(0.010, 0.014), length = rng.uniform(0.20, 0.26);
  ObjectModel model =
      with_part("hammer", rng, Box{{0, 0, head_radius}, {head_radius, head / 2, head_radius}});
  model.solid.parts.emplace_back(Capsule{{0, 0, head_radius}, {length - radius, 0, head_radius}, radius});
  model.footprints.push_back(rectangle(Vector2d::Zero(), {head_radius, head / 2}, 2 * head_radius));
  model.footprints.push_back(rectangle({length / 2, 0}, {length / 2, radius}, head_radius + radius));
  return model;
}

ObjectModel make_banana(Rng& rng) {
  const double thickness = rng.uniform(0.014, 0.019), arc_radius = rng.uniform(0.08, 0.12);
  const double half_angle = rng.uniform(0.08, 0.10) / arc_radius;
  ObjectModel model = with_part("banana", rng, Ball{{0, arc_radius, thickness}, thickness});
  add_arc(model, arc_radius, -half_angle, half_angle, thickness, thickness);
  const double reach = arc_radius * std::sin(half_angle) + thickness;
  const double low = arc_radius * std::cos(half_angle) - thickness, high = arc_radius + thickness;
  // Its middle over the origin.
  model.solid.T_world_solid.translation() = Vector3d(0, -(low + high) / 2, 0);
  model.footprints.push_back(rectangle(Vector2d::Zero(), {reach, (high - low) / 2}, 2 * thickness));
  return model;
}

ObjectModel make_goblet(Rng& rng) {
  const double foot = rng.uniform(0.028, 0.036), stem = rng.uniform(0.05, 0.09);
  const double cup = rng.uniform(0.025, 0.036), height = stem + rng.uniform(0.04, 0.08);
  ObjectModel model = with_part("goblet", rng, Cylinder{foot, 0, 0.006});
  model.solid.parts.emplace_back(Cylinder{rng.uniform(0.006, 0.010), 0, stem});
  model.solid.parts.emplace_back(Cylinder{cup, stem, height});
  model.footprints.push_back(circle(std::max(foot, cup), height));
  return model;
}

ObjectModel make_pan(Rng& rng) {
  const double radius = rng.uniform(0.07, 0.10), height = rng.uniform(0.04, 0.06);
  const double wall = rng.uniform(0.003, 0.005), handle = rng.uniform(0.12, 0.16);
  const double thickness = rng.uniform(0.008, 0.012), handle_z = 0.7 * height;
  ObjectModel model = with_part("pan", rng, Cylinder{radius, 0, height});
  model.solid.cavity = Cylinder{radius - wall, wall, 2 * height};
  model.solid.parts.emplace_back(
      Capsule{{radius + thickness, 0, handle_z}, {radius + handle, 0, handle_z}, thickness});
  model.footprints.push_back(circle(radius, height));
  model.footprints.push_back(
      rectangle({radius + handle / 2, 0}, {handle / 2 + thickness, thickness}, handle_z + thickness));
  return model;
}

ObjectModel make_bracket(Rng& rng) {
  const double width = rng.uniform(0.03, 0.06), thickness = rng.uniform(0.008, 0.02);
  const double base = rng.uniform(0.06, 0.10), height = rng.uniform(0.06, 0.10);
  ObjectModel model =
      with_part("bracket", rng, Box{{0, 0, thickness / 2}, {base / 2, width / 2, thickness / 2}});
  model.solid.parts.emplace_back(
      Box{{-base / 2 + thickness / 2, 0, height / 2}, {thickness / 2, width / 2, height / 2}});
  model.footprints.push_back(rectangle(Vector2d::Zero(), {base / 2, width / 2}, height));
  return model;
}

ObjectModel make_ring(Rng& rng) {
  const double thickness = rng.uniform(0.008, 0.013), radius = rng.uniform(0.035, 0.06);
  ObjectModel model = with_part("ring", rng, Ball{{0, radius, thickness}, thickness});
  add_arc(model, radius, 0, 2 * pi, thickness, thickness);
  model.footprints.push_back(circle(radius + thickness, 2 * thickness));
  return model;
}

ObjectModel make_dumbbell(Rng& rng) {
  const double disc = rng.uniform(0.025, 0.037), thickness = rng.uniform(0.02, 0.04);
  const double bar = rng.uniform(0.010, 0.016), length = rng.uniform(0.15, 0.20);
  ObjectModel model = with_part("dumbbell", rng, Cylinder{disc, 0, thickness});
  model.solid.parts.emplace_back(Cylinder{bar, 0, length});
  model.solid.parts.emplace_back(Cylinder{disc, length - thickness, length});
  lay_down(model, length / 2, disc);
  model.footprints.push_back(rectangle(Vector2d::Zero(), {length / 2, disc}, 2 * disc));
  return model;
}

ObjectModel make_household_object(Rng& rng) {
  constexpr std::array<ObjectMaker, 8> kMakers{make_screwdriver, make_hammer,  make_banana, make_goblet,
                                               make_pan,         make_bracket, make_ring,   make_dumbbell};
  return rng.pick(kMakers)(rng);
}

}  // namespace graspd

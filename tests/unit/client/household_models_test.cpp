// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/simulate/household_models.hpp"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <string>

#include "client/simulate/scene_builder.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;

constexpr std::array kMakers{make_screwdriver, make_hammer,  make_banana, make_goblet,
                             make_pan,         make_bracket, make_ring,   make_dumbbell};

bool is_above_a_footprint(const ObjectModel& model, const Vector3d& p) {
  for (const Footprint& f : model.footprints) {
    const Eigen::Vector2d d = (Eigen::Rotation2Dd(-f.yaw_rad) * (p.head<2>() - f.center)).cwiseAbs();
    const Eigen::Vector2d outside = (d - f.half).cwiseMax(0);
    if (outside.norm() <= f.radius + 1e-6 && p.z() <= f.z_max + 1e-6) return true;
  }
  return false;
}

/// Calls look(p) for points of a grid that are in the model.
template <class Look>
void for_points_inside(const ObjectModel& model, const Look& look) {
  constexpr double kStep = 0.003, kReach = 0.3, kHigh = 0.2;
  for (double x = -kReach; x <= kReach; x += kStep)
    for (double y = -kReach; y <= kReach; y += kStep)
      for (double z = -0.01; z <= kHigh; z += kStep)
        if (const Vector3d p(x, y, z); signed_distance(model.solid, p) < 0) look(p);
}

TEST(HouseholdModels, AreWhereTheirFootprintsSay) {
  for (const auto make : kMakers) {
    Rng rng(7);
    const ObjectModel model = make(rng);
    int inside = 0, beside = 0, below = 0;
    for_points_inside(model, [&](const Vector3d& p) {
      ++inside;
      beside += is_above_a_footprint(model, p) ? 0 : 1;
      below += p.z() < 0 ? 1 : 0;
    });
    EXPECT_GT(inside, 100) << model.solid.kind;
    EXPECT_EQ(beside, 0) << model.solid.kind;
    EXPECT_EQ(below, 0) << model.solid.kind;
  }
}

TEST(HouseholdModels, AScenesObjectsAreOfAllKinds) {
  std::map<std::string, int> kinds;
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    for (const Solid& solid : build_scene({SceneKind::kHousehold, {}}, seed).solids) ++kinds[solid.kind];
  for (const char* kind : {"screwdriver", "hammer", "banana", "goblet", "pan", "bracket", "ring", "dumbbell"})
    EXPECT_GT(kinds[kind], 0) << kind;
}

}  // namespace
}  // namespace graspd

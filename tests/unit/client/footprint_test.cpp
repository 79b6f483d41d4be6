// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/simulate/footprint.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "client/simulate/rng.hpp"

namespace graspd {
namespace {

Footprint random_footprint(Rng& rng) {
  Footprint f;
  f.center = {rng.uniform(-1, 1), rng.uniform(-1, 1)};
  if (rng.index(3) > 0) f.half = {rng.uniform(0, 0.5), rng.uniform(0, 0.5)};
  if (rng.index(3) > 0) f.radius = rng.uniform(0, 0.4);
  f.yaw_rad = rng.uniform(-4, 4);
  f.z_max = 1;
  return f;
}

/// From a point to the rectangle in the middle of a footprint.
double to_rectangle(const Footprint& f, const Eigen::Vector2d& p) {
  const Eigen::Vector2d local = Eigen::Rotation2Dd(-f.yaw_rad) * (p - f.center);
  return (local.cwiseAbs() - f.half).cwiseMax(0).norm();
}

/// The same by looking at points all over the rectangle of a, its border included.
double clearance_by_force(const Footprint& a, const Footprint& b) {
  constexpr int kSteps = 60;
  double nearest = 1e9;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; j <= kSteps; ++j) {
      const Eigen::Vector2d local(a.half.x() * (2.0 * i / kSteps - 1), a.half.y() * (2.0 * j / kSteps - 1));
      nearest = std::min(nearest, to_rectangle(b, a.center + Eigen::Rotation2Dd(a.yaw_rad) * local));
    }
  }
  return nearest - a.radius - b.radius;
}

TEST(Footprint, ClearanceAgreesWithBruteForce) {
  Rng rng(5);
  for (int i = 0; i < 500; ++i) {
    const Footprint a = random_footprint(rng);
    const Footprint b = random_footprint(rng);
    const double expected = clearance_by_force(a, b);
    EXPECT_NEAR(clearance(a, b), expected, 2 * a.half.norm() / 60 + 1e-9);
    EXPECT_NEAR(clearance(a, b), clearance(b, a), 1e-12);
  }
}

TEST(Footprint, CollidesOnCommonHeightsOnly) {
  Footprint low;
  low.half = {0.1, 0.1};
  low.z_max = 0.2;
  Footprint high = low;
  high.z_min = 0.2;
  high.z_max = 0.3;
  EXPECT_FALSE(collide(low, high, 0.01));
  high.z_min = 0.19;
  EXPECT_TRUE(collide(low, high, 0.01));
}

TEST(Footprint, RectanglesThatOnlyOverlapCollide) {
  Footprint a;
  a.half = {0.1, 0.1};
  a.z_max = 1;
  const Footprint b = moved(a, {0.15, 0}, std::numbers::pi / 4, 0);
  EXPECT_TRUE(collide(a, b, 0));
  EXPECT_FALSE(collide(a, moved(a, {0.3, 0}, 0, 0), 0.05));
  EXPECT_TRUE(collide(a, moved(a, {0.24, 0}, 0, 0), 0.05));
}

}  // namespace
}  // namespace graspd

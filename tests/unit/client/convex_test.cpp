// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/simulate/convex.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "client/simulate/rng.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;

struct Case {
  std::string name;
  Convex body;
};

std::vector<Case> cases() {
  return {{"box", Box{{0.1, -0.2, 0.3}, {0.5, 0.2, 0.8}}},
          {"cylinder", Cylinder{0.6, -0.4, 0.9}},
          {"flat_cylinder", Cylinder{1.0, 0.0, 0.01}},
          {"ball", Ball{{0.2, 0.1, -0.3}, 0.7}},
          {"ball_slice", BallSlice{0.9, -0.85, 0.0}},
          {"capsule", Capsule{{-0.4, 0.1, 0.0}, {0.5, 0.3, 0.6}, 0.25}},
          {"point_capsule", Capsule{{0.1, 0.1, 0.1}, {0.1, 0.1, 0.1}, 0.4}}};
}

Vector3d random_vector(Rng& rng, double size) {
  return {rng.uniform(-size, size), rng.uniform(-size, size), rng.uniform(-size, size)};
}

/// From a point around the body to one near its middle, of any length; one in eight along an axis.
Ray random_ray(Rng& rng) {
  const Vector3d origin = random_vector(rng, 3);
  if (rng.index(8) == 0) return {origin * 0.2, Vector3d::Unit(rng.index(3)) * rng.uniform(-2, 2)};
  return {origin, (random_vector(rng, 0.6) - origin) * rng.uniform(0.2, 2)};
}

class ConvexShapes : public testing::TestWithParam<Case> {};

TEST_P(ConvexShapes, RaysAgreeWithTheInsideTestAlongThem) {
  Rng rng(1);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Ray ray = random_ray(rng);
    const auto interval = intersect(GetParam().body, ray);
    hits += interval.has_value();
    for (int k = 0; k < 200; ++k) {
      const double t = rng.uniform(-5, 5) / ray.direction.norm();
      const double distance = signed_distance(GetParam().body, ray.at(t));
      if (std::abs(distance) < 1e-9) continue;
      const bool inside = interval && t > interval->enter.t && t < interval->leave.t;
      EXPECT_EQ(inside, distance < 0) << "t " << t << " distance " << distance;
    }
  }
  EXPECT_GT(hits, 200);
}

TEST_P(ConvexShapes, CrossingsLieOnTheSurfaceWithNormalsThatPointOut) {
  Rng rng(2);
  for (int i = 0; i < 2000; ++i) {
    const Ray ray = random_ray(rng);
    const auto interval = intersect(GetParam().body, ray);
    if (!interval) continue;
    EXPECT_LE(interval->enter.normal.dot(ray.direction), 1e-9);
    EXPECT_GE(interval->leave.normal.dot(ray.direction), -1e-9);
    for (const Crossing& crossing : {interval->enter, interval->leave}) {
      EXPECT_NEAR(crossing.normal.norm(), 1, 1e-9);
      EXPECT_NEAR(signed_distance(GetParam().body, ray.at(crossing.t)), 0, 1e-9);
      EXPECT_GT(signed_distance(GetParam().body, ray.at(crossing.t) + 1e-6 * crossing.normal), 0);
    }
  }
}

TEST_P(ConvexShapes, SignedDistanceNeverExceedsTheWayToTheSurface) {
  Rng rng(3);
  std::vector<Vector3d> surface;
  for (int i = 0; i < 3000; ++i) {
    const Ray ray = random_ray(rng);
    if (const auto interval = intersect(GetParam().body, ray)) surface.push_back(ray.at(interval->enter.t));
  }
  for (int i = 0; i < 200; ++i) {
    const Vector3d point = random_vector(rng, 1.5);
    const double distance = std::abs(signed_distance(GetParam().body, point));
    for (const Vector3d& on : surface) EXPECT_LE(distance, (on - point).norm() + 1e-9);
  }
}

TEST_P(ConvexShapes, BoundsHoldEverything) {
  Rng rng(4);
  const Eigen::AlignedBox3d box = bounds(GetParam().body);
  for (int i = 0; i < 2000; ++i) {
    const Ray ray = random_ray(rng);
    const auto interval = intersect(GetParam().body, ray);
    if (!interval) continue;
    EXPECT_LT(box.exteriorDistance(ray.at(interval->enter.t)), 1e-9);
    EXPECT_LT(box.exteriorDistance(ray.at(interval->leave.t)), 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(All, ConvexShapes, testing::ValuesIn(cases()),
                         [](const auto& instance) { return instance.param.name; });

TEST(Convex, KnownHits) {
  const Ray down{{0, 0, 2}, {0, 0, -1}};
  EXPECT_DOUBLE_EQ(intersect(Box{{0, 0, 0}, {1, 1, 0.5}}, down)->enter.t, 1.5);
  EXPECT_DOUBLE_EQ(intersect(Cylinder{0.1, 0, 0.3}, down)->enter.t, 1.7);
  EXPECT_DOUBLE_EQ(intersect(Ball{{0, 0, 0}, 0.25}, down)->enter.t, 1.75);
  EXPECT_DOUBLE_EQ(intersect(BallSlice{1, -0.5, 0.5}, down)->enter.t, 1.5);
  EXPECT_DOUBLE_EQ(intersect(Capsule{{0, 0, 0}, {0, 0, 1}, 0.1}, down)->enter.t, 0.9);
  EXPECT_FALSE(intersect(Cylinder{0.1, 0, 0.3}, Ray{{0.2, 0, 2}, {0, 0, -1}}));
}

}  // namespace
}  // namespace graspd

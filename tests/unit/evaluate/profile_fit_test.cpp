// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/profile_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace graspd {
namespace {

/// An arc in y and z around (0.01, 0.02), and along x; z is smallest in its middle.
std::vector<Eigen::Vector3f> arc(float radius, float from, float to) {
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i <= 30; ++i) {
    const float t = from + (to - from) * static_cast<float>(i) / 30;
    points.emplace_back(0.001f * static_cast<float>(i % 5), 0.01f + radius * std::sin(t),
                        0.02f - radius * std::cos(t));
  }
  return points;
}

TEST(ProfileFit, FindsTheCircleOfAnArc) {
  for (const float radius : {0.01f, 0.03f, 0.07f}) {
    const auto circle = fit_circle(arc(radius, -0.9f, 0.4f));
    ASSERT_TRUE(circle) << radius;
    EXPECT_NEAR(circle->radius, radius, 1e-4f);
    EXPECT_NEAR(circle->y, 0.01f, 1e-4f);
    EXPECT_NEAR(circle->z, 0.02f, 1e-4f);
  }
}

TEST(ProfileFit, FlatHollowFewAndScatteredPointsAreNoCircle) {
  std::vector<Eigen::Vector3f> flat, scattered;
  for (int i = 0; i < 40; ++i) {
    const float y = 0.001f * static_cast<float>(i);
    flat.emplace_back(0.0f, y, 0.3f * y);
    scattered.emplace_back(0.0f, y, i % 2 == 0 ? 0.01f : -0.01f);
  }
  auto hollow = arc(0.03f, -0.9f, 0.9f);
  for (Eigen::Vector3f& p : hollow) p.z() = -p.z();
  EXPECT_FALSE(fit_circle(flat));
  EXPECT_FALSE(fit_circle(scattered));
  EXPECT_FALSE(fit_circle(hollow));
  EXPECT_FALSE(fit_circle({}));
  EXPECT_FALSE(fit_circle(std::vector<Eigen::Vector3f>(50, {1, 2, 3})));
}

TEST(ProfileFit, NormalsPointToTheViewpoint) {
  std::vector<Eigen::Vector3f> plane;
  for (int i = 0; i < 25; ++i)
    plane.emplace_back(0.001f * static_cast<float>(i % 5), 0.001f * static_cast<float>(i / 5), 0.0f);
  EXPECT_GT(plane_normal(plane, {0, 0, 1})->z(), 0.999f);
  EXPECT_LT(plane_normal(plane, {0, 0, -1})->z(), -0.999f);
  plane.resize(5);
  EXPECT_FALSE(plane_normal(plane, {0, 0, 1}));
}

TEST(ProfileFit, NeighborsAreWithinTheRadius) {
  const std::vector<Eigen::Vector3f> points{{0, 0, 0}, {0, 0, 0.9f}, {0, 0, 1.1f}};
  EXPECT_EQ(neighbors(points, {0, 0, 0}, 1).size(), 2u);
}

}  // namespace
}  // namespace graspd

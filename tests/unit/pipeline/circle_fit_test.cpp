// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/circle_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory_resource>
#include <numbers>
#include <random>
#include <vector>

namespace graspd {
namespace {

using Points = std::pmr::vector<Eigen::Vector2f>;

constexpr float kAnyRadius = 0.06f;
constexpr float kTolerance = 0.0035f;
constexpr float kDegree = std::numbers::pi_v<float> / 180;

/// n points evenly over an arc about the upward direction; noise_m: uniform, either way along the radius.
Points arc(const Eigen::Vector2f& center, float radius, float arc_deg, int n, float noise_m = 0,
           unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> noise(-1, 1);
  Points points;
  for (int i = 0; i < n; ++i) {
    const float along = static_cast<float>(i) / static_cast<float>(n - 1) - 0.5f;
    const float angle = arc_deg * kDegree * along, r = radius + noise_m * noise(random);
    points.emplace_back(center + r * Eigen::Vector2f(std::sin(angle), -std::cos(angle)));
  }
  return points;
}

void add_line(Points& points, const Eigen::Vector2f& from, const Eigen::Vector2f& to, int n) {
  for (int i = 0; i < n; ++i)
    points.emplace_back(from + (to - from) * static_cast<float>(i) / static_cast<float>(n));
}

void expect_circle(const std::optional<Circle>& circle, const Eigen::Vector2f& center, float radius,
                   float tolerance_m) {
  ASSERT_TRUE(circle);
  EXPECT_NEAR(circle->radius, radius, tolerance_m);
  EXPECT_LT((circle->center - center).norm(), tolerance_m);
}

TEST(CircleFit, TooFewPoints) {
  EXPECT_FALSE(fit_circle({}, kAnyRadius, kTolerance));
  EXPECT_FALSE(fit_circle(arc({0, 0}, 0.03f, 180, 11), kAnyRadius, kTolerance));
  EXPECT_TRUE(fit_circle(arc({0, 0}, 0.03f, 180, 12), kAnyRadius, kTolerance));
}

TEST(CircleFit, OnePlaceIsNoCircle) {
  EXPECT_FALSE(fit_circle(Points(50, Eigen::Vector2f(0.01f, 0.02f)), kAnyRadius, kTolerance));
}

TEST(CircleFit, ExactArcs) {
  for (const float radius : {0.01f, 0.02f, 0.035f, 0.055f})
    for (const float arc_deg : {90.0f, 130.0f, 180.0f, 300.0f}) {
      SCOPED_TRACE(radius);
      SCOPED_TRACE(arc_deg);
      const Eigen::Vector2f center(-0.004f, radius);
      expect_circle(fit_circle(arc(center, radius, arc_deg, 60), kAnyRadius, kTolerance), center, radius,
                    1e-4f);
    }
}

TEST(CircleFit, ManyPointsSayTheSame) {
  const Eigen::Vector2f center(0.01f, 0.03f);
  expect_circle(fit_circle(arc(center, 0.03f, 150, 5000), kAnyRadius, kTolerance), center, 0.03f, 1e-4f);
}

TEST(CircleFit, NoiseOfTwoMillimetres) {
  for (unsigned seed = 1; seed <= 20; ++seed)
    for (const float radius : {0.02f, 0.03f, 0.04f}) {
      SCOPED_TRACE(seed);
      SCOPED_TRACE(radius);
      const Eigen::Vector2f center(0.002f, radius);
      expect_circle(fit_circle(arc(center, radius, 170, 120, 0.002f, seed), kAnyRadius, kTolerance), center,
                    radius, 0.003f);
    }
}

TEST(CircleFit, AFewStrayPointsDoNotMatter) {
  const Eigen::Vector2f center(0, 0.025f);
  Points points = arc(center, 0.025f, 160, 100);
  add_line(points, {-0.02f, 0.03f}, {0.02f, 0.05f}, 8);
  expect_circle(fit_circle(points, kAnyRadius, kTolerance), center, 0.025f, 0.001f);
}

TEST(CircleFit, PlanesAreNoCircles) {
  for (const float slope : {0.0f, 0.3f, -1.0f}) {
    SCOPED_TRACE(slope);
    Points points;
    add_line(points, {-0.03f, -0.03f * slope}, {0.03f, 0.03f * slope}, 100);
    EXPECT_FALSE(fit_circle(points, kAnyRadius, kTolerance));
    std::mt19937 random(3);
    std::normal_distribution<float> noise(0, 0.001f);
    for (Eigen::Vector2f& p : points) p.y() += noise(random);
    EXPECT_FALSE(fit_circle(points, kAnyRadius, kTolerance)) << "with noise";
  }
}

TEST(CircleFit, BoxesAreNoCircles) {
  Points corner;
  add_line(corner, {-0.025f, 0}, {0.025f, 0}, 60);
  add_line(corner, {-0.025f, 0}, {-0.025f, 0.03f}, 40);
  EXPECT_FALSE(fit_circle(corner, kAnyRadius, kTolerance)) << "top and one side";
  Points both = corner;
  add_line(both, {0.025f, 0}, {0.025f, 0.03f}, 40);
  EXPECT_FALSE(fit_circle(both, kAnyRadius, kTolerance)) << "top and both sides";
}

TEST(CircleFit, TheEdgeOfAPlateIsOneOnlyToASensorThatScatters) {
  Points edge;
  add_line(edge, {-0.007f, 0}, {0.007f, 0}, 30);
  add_line(edge, {0.007f, 0}, {0.007f, 0.020f}, 43);
  EXPECT_TRUE(fit_circle(edge, kAnyRadius, kTolerance));
  EXPECT_FALSE(fit_circle(edge, kAnyRadius, 0.0015f));
  const Eigen::Vector2f center(0, 0.007f);
  expect_circle(fit_circle(arc(center, 0.007f, 180, 60, 0.0005f), kAnyRadius, 0.0015f), center, 0.007f,
                0.0005f);
}

TEST(CircleFit, LargerThanAskedForIsNone) {
  const Points points = arc({0, 0.05f}, 0.05f, 120, 80);
  EXPECT_FALSE(fit_circle(points, 0.049f, kTolerance));
  EXPECT_TRUE(fit_circle(points, 0.051f, kTolerance));
}

TEST(CircleFit, AShortArcTellsNothing) {
  EXPECT_FALSE(fit_circle(arc({0, 0.05f}, 0.05f, 30, 60), kAnyRadius, kTolerance));
}

}  // namespace
}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/draw/projection.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace graspd {
namespace {

using Kind = Projection::Kind;

const std::vector<Eigen::Vector3f> kSquare{
    {-0.1f, -0.1f, 1}, {0.1f, -0.1f, 1}, {-0.1f, 0.1f, 1}, {0.1f, 0.1f, 1}};

TEST(Projection, FittedPointsFillThePictureButForAMargin) {
  for (const Kind kind : {Kind::kCamera, Kind::kParallel}) {
    Projection projection(kind, Eigen::Isometry3f::Identity());
    projection.fit(kSquare, 0, 300, 200);
    const auto low = projection.project(kSquare[0]);
    const auto high = projection.project(kSquare[3]);
    ASSERT_TRUE(low && high);
    EXPECT_NEAR(low->v, 12, 1e-3);
    EXPECT_NEAR(high->v, 188, 1e-3);
    EXPECT_NEAR((low->u + high->u) / 2, 150, 1e-3);
    EXPECT_NEAR(high->u - low->u, high->v - low->v, 1e-3) << "not the same scale in both directions";
    EXPECT_NEAR(projection.pixels_per_m(1), 176 / 0.2, 0.1);
  }
}

TEST(Projection, NearerIsNearer) {
  for (const Kind kind : {Kind::kCamera, Kind::kParallel}) {
    Projection projection(kind, Eigen::Isometry3f::Identity());
    const auto near = projection.project({0, 0, 0.5f});
    const auto far = projection.project({0, 0, 2});
    const auto pulled = projection.project({0, 0, 2}, 1);
    ASSERT_TRUE(near && far && pulled);
    EXPECT_GT(near->nearness, pulled->nearness);
    EXPECT_GT(pulled->nearness, far->nearness);
    EXPECT_NEAR(projection.depth_of(near->nearness), 0.5f, 1e-6);
    EXPECT_NEAR(projection.depth_of(pulled->nearness), 1.0f, 1e-6);
  }
}

TEST(Projection, WhatIsBehindACameraOrNowhereIsNotSeen) {
  const Projection projection(Kind::kCamera, Eigen::Isometry3f::Identity());
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(projection.project({0, 0, -1}));
  EXPECT_FALSE(projection.project({0, 0, 0}));
  EXPECT_FALSE(projection.project({kNan, 0, 1}));
  EXPECT_FALSE(projection.project({0, 0, 1}, 2));
}

TEST(Projection, OutliersAndNothingAtAllCanBeFitted) {
  std::vector<Eigen::Vector3f> points(200, Eigen::Vector3f(0, 0, 1));
  for (std::size_t i = 0; i < points.size(); ++i) points[i].x() = 0.001f * static_cast<float>(i);
  points.push_back({1000, 1000, 1});
  Projection projection(Kind::kCamera, Eigen::Isometry3f::Identity());
  projection.fit(points, 0.01f, 100, 100);
  EXPECT_NEAR(projection.project(points[100])->u, 50, 2);
  projection.fit({}, 0, 100, 100);
  EXPECT_TRUE(projection.project({0, 0, 1}));
}

TEST(Looking, PutsUpAtTheTop) {
  const Eigen::Isometry3f T = looking({1, 2, 3}, {0, 0, -2}, {0, 1, 0});
  EXPECT_TRUE((T * Eigen::Vector3f(1, 2, 3)).isZero(1e-6f));
  EXPECT_TRUE((T * Eigen::Vector3f(1, 2, 0)).isApprox(Eigen::Vector3f(0, 0, 3), 1e-6f));
  EXPECT_TRUE((T * Eigen::Vector3f(1, 3, 3)).isApprox(Eigen::Vector3f(0, -1, 0), 1e-6f))
      << "up is -y of a picture";
  EXPECT_NEAR(T.linear().determinant(), 1, 1e-5);
  EXPECT_NEAR(looking({0, 0, 0}, {0, 0, 1}, {0, 0, 1}).linear().determinant(), 1, 1e-5);
}

}  // namespace
}  // namespace graspd

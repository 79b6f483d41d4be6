// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/level.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "tests/support/clouds.hpp"

namespace graspd {
namespace {

constexpr float kSpacing = 0.008f;
const Plane kLevel{Eigen::Vector3f::UnitZ(), -0.3f};

/// Every 8 mm on the plane from (0, 0) to (width, depth), but for what is inside the hole.
PointCloud board(float width, float depth, const Eigen::AlignedBox2f& hole = {}) {
  PointCloud cloud;
  const PointCloud all = grid_patch({0, 0, 0.3f}, {kSpacing, 0, 0}, {0, kSpacing, 0},
                                    static_cast<int>(width / kSpacing), static_cast<int>(depth / kSpacing));
  for (std::size_t i = 0; i < all.size(); ++i)
    if (hole.isEmpty() || !hole.contains(Eigen::Vector2f(all.x[i], all.y[i]))) cloud.push_back(all.point(i));
  return cloud;
}

LevelExtent extent_of(const PointCloud& cloud) {
  std::vector<std::uint32_t> all(cloud.size());
  std::iota(all.begin(), all.end(), 0u);
  return {cloud, all, kLevel, kSpacing};
}

TEST(Level, CoversWhereItsPointsAreAndALittleAround) {
  const LevelExtent extent = extent_of(board(0.4f, 0.25f));
  EXPECT_NEAR(extent.area_m2(), 0.1f, 0.01f);
  EXPECT_NEAR(extent.width_m(), 0.25f, 0.025f);
  for (const float height : {-1.0f, 0.3f, 2.0f}) {
    EXPECT_TRUE(extent.covers({0.2f, 0.1f, height}, 0)) << "whatever the height";
    EXPECT_FALSE(extent.covers({0.43f, 0.1f, height}, 0));
    EXPECT_TRUE(extent.covers({0.43f, 0.1f, height}, LevelExtent::kMostCells));
    EXPECT_FALSE(extent.covers({0.47f, 0.1f, height}, LevelExtent::kMostCells));
    EXPECT_FALSE(extent.covers({0.2f, -0.07f, height}, LevelExtent::kMostCells));
  }
}

TEST(Level, WhatThingsOnItHideIsCoveredButIsNoAreaOfItsOwn) {
  const LevelExtent extent =
      extent_of(board(0.4f, 0.25f, {Eigen::Vector2f(0.1f, 0.05f), Eigen::Vector2f(0.3f, 0.2f)}));
  EXPECT_TRUE(extent.covers({0.2f, 0.12f, 0.3f}, 0));
  EXPECT_NEAR(extent.area_m2(), 0.07f, 0.01f);
}

TEST(Level, OnlyTheLargestPartCounts) {
  const PointCloud both = joined(board(0.4f, 0.25f), moved(board(0.1f, 0.1f), [] {
                                   Eigen::Isometry3f T = Eigen::Isometry3f::Identity();
                                   T.translation().x() = 0.6f;
                                   return T;
                                 }()));
  const LevelExtent extent = extent_of(both);
  EXPECT_FALSE(extent.covers({0.65f, 0.05f, 0.3f}, LevelExtent::kMostCells));
  EXPECT_NEAR(extent.area_m2(), 0.1f, 0.01f);
}

TEST(Level, APointFarAwayDoesNotMatter) {
  for (const float far : {-1e7f, -30.0f, 30.0f, 1e7f}) {
    PointCloud cloud = board(0.4f, 0.25f);
    cloud.push_back({far, 0, 0.3f});
    const LevelExtent extent = extent_of(cloud);
    EXPECT_TRUE(extent.covers({0.2f, 0.1f, 0.3f}, 0));
    EXPECT_FALSE(extent.covers({far, 0, 0.3f}, LevelExtent::kMostCells));
    EXPECT_NEAR(extent.area_m2(), 0.1f, 0.01f);
  }
}

TEST(Level, NothingWithoutPoints) {
  const LevelExtent extent = extent_of({});
  EXPECT_EQ(extent.area_m2(), 0);
  EXPECT_FALSE(extent.covers({0, 0, 0}, LevelExtent::kMostCells));
}

TEST(Level, BlocksTheWayThroughFromEitherSide) {
  const Level level{kLevel, extent_of(board(0.4f, 0.25f))};
  const Eigen::Vector3f above(0.2f, 0.1f, 0.5f), below(0.25f, 0.12f, 0.1f), beside(0.7f, 0.1f, 0.1f);
  EXPECT_TRUE(level.blocks(above, below));
  EXPECT_TRUE(level.blocks(below, above));
  EXPECT_FALSE(level.blocks(above, {0.3f, 0.1f, 0.35f})) << "stays above";
  EXPECT_FALSE(level.blocks(below, {0.3f, 0.1f, 0.25f})) << "stays below";
  EXPECT_FALSE(level.blocks(beside, {0.7f, 0.1f, 0.5f})) << "passes beside it";
  EXPECT_FALSE(level.blocks(beside, above)) << "meets the plane beyond the border";
}

TEST(Level, WhatIsSolidBlocksTheWayBelowToo) {
  Level level{kLevel, extent_of(board(0.4f, 0.25f))};
  const Eigen::Vector3f below(0.2f, 0.1f, 0.1f), before(0.2f, -0.2f, 0.1f);
  EXPECT_FALSE(level.blocks(before, below));
  level.is_solid = true;
  EXPECT_TRUE(level.blocks(before, below));
  EXPECT_TRUE(level.blocks(below, before));
  EXPECT_FALSE(level.blocks(before, {0.2f, -0.1f, 0.1f})) << "ends before it";
  EXPECT_FALSE(level.blocks({0.2f, 0.1f, 0.5f}, {0.2f, 0.1f, 0.35f})) << "stays above";
}

TEST(Level, ThingsStandOnTheHighestOneBelowThemThatIsThere) {
  Level floor{{Eigen::Vector3f::UnitZ(), 0}, extent_of(board(2, 2))};
  const std::vector<Level> levels{floor, {kLevel, extent_of(board(0.4f, 0.25f))}};
  EXPECT_EQ(level_under(levels, {0.2f, 0.1f, 0.35f}, {0.2f, 0.1f, 0.31f}), 1u);
  EXPECT_EQ(level_under(levels, {0.2f, 0.1f, 0.35f}, {0.2f, 0.1f, 0.29f}), 1u) << "noise";
  EXPECT_EQ(level_under(levels, {0.2f, 0.1f, 0.15f}, {0.2f, 0.1f, 0.1f}), 0u) << "below the board";
  EXPECT_EQ(level_under(levels, {0.8f, 0.1f, 0.5f}, {0.8f, 0.1f, 0.4f}), 0u)
      << "beside it, hidden at the bottom";
  EXPECT_EQ(level_under(levels, {9, 9, 0.5f}, {9, 9, 0.4f}), 0u) << "nowhere";
}

}  // namespace
}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/neighborhoods.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/clouds.hpp"

namespace graspd {
namespace {

std::pmr::vector<std::uint32_t> brute_force(const PointCloud& cloud, std::size_t s, float radius_m) {
  std::pmr::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    const float dx = cloud.x[i] - cloud.x[s], dy = cloud.y[i] - cloud.y[s], dz = cloud.z[i] - cloud.z[s];
    if (dx * dx + dy * dy + dz * dz <= radius_m * radius_m) found.push_back(i);
  }
  return found;
}

void expect_brute_force(const PointCloud& cloud, float radius_m) {
  const Neighborhoods neighborhoods = find_neighborhoods(cloud, {radius_m});
  ASSERT_EQ(neighborhoods.size(), cloud.size());
  for (std::size_t s = 0; s < cloud.size(); ++s) {
    const auto list = neighborhoods.of(s);
    std::pmr::vector<std::uint32_t> sorted(list.begin(), list.end());
    std::sort(sorted.begin(), sorted.end());
    ASSERT_EQ(sorted, brute_force(cloud, s, radius_m))
        << "point " << s << " at " << cloud.point(s).transpose();
  }
}

TEST(Neighborhoods, EmptyCloud) {
  EXPECT_EQ(find_neighborhoods({}, {0.009f}).size(), 0u);
}

TEST(Neighborhoods, OnePointIsItsOwnNeighbour) {
  expect_brute_force(random_cloud(1, {1, 1, 1}, {2, 2, 2}, 1), 0.009f);
}

TEST(Neighborhoods, AllPointsEqual) {
  expect_brute_force(random_cloud(300, {1, -1, 2}, {1, -1, 2}, 1), 0.009f);
}

TEST(Neighborhoods, RandomClouds) {
  for (std::uint32_t seed = 0; seed < 4; ++seed)
    expect_brute_force(random_cloud(1500, {-0.05f, -0.04f, -0.03f}, {0.05f, 0.04f, 0.03f}, seed), 0.009f);
}

TEST(Neighborhoods, RadiusLargerThanTheCloud) {
  expect_brute_force(random_cloud(200, {-0.01f, -0.01f, -0.01f}, {0.01f, 0.01f, 0.01f}, 1), 0.1f);
}

TEST(Neighborhoods, DenseClustersFarApart) {
  PointCloud cloud;
  for (std::uint32_t k = 0; k < 5; ++k) {
    const Eigen::Vector3f at = random_cloud(1, {-5, -5, -5}, {5, 5, 5}, 10 + k).point(0);
    cloud = joined(cloud, random_cloud(300, at, at + Eigen::Vector3f::Constant(0.012f), 20 + k));
  }
  expect_brute_force(cloud, 0.009f);
}

TEST(Neighborhoods, NegativeCoordinates) {
  expect_brute_force(random_cloud(1000, {-3.05f, -2.05f, -1.05f}, {-3, -2, -1}, 7), 0.009f);
}

TEST(Neighborhoods, LinesAndPlanes) {
  expect_brute_force(random_cloud(500, {-0.3f, 0, 0}, {0.3f, 0, 0}, 8), 0.009f);
  expect_brute_force(random_cloud(800, {-0.1f, 0, -0.1f}, {0.1f, 0, 0.1f}, 9), 0.009f);
}

// Points whose spacing is the radius itself lie on the borders of cells, and exactly one radius apart as far
// as rounding allows: the case where a neighbour can hide two cells away.
TEST(Neighborhoods, PointsOnCellBorders) {
  for (const float radius : {0.009f, 0.01f, 0.0073f})
    for (const float offset : {0.0f, -0.5f, 1.0f, 2.7f}) {
      const Eigen::Vector3f corner = Eigen::Vector3f::Constant(radius * std::round(offset / radius));
      expect_brute_force(grid_patch(corner, {radius, 0, 0}, {0, radius, 0}, 30, 10), radius);
      expect_brute_force(grid_patch(corner, {0.5f * radius, 0, 0}, {0, 0, radius / 3}, 20, 20), radius);
    }
}

TEST(Neighborhoods, SkippedPointsHaveNoneButAreNeighbours) {
  const PointCloud cloud = random_cloud(1500, {-0.05f, -0.04f, -0.03f}, {0.05f, 0.04f, 0.03f}, 12);
  std::pmr::vector<std::uint8_t> skip(cloud.size());
  for (std::size_t i = 0; i < skip.size(); ++i) skip[i] = cloud.z[i] < -0.005f || i % 7 == 0 ? 1 : 0;
  const Neighborhoods all = find_neighborhoods(cloud, {0.009f}),
                      some = find_neighborhoods(cloud, {0.009f}, skip);
  ASSERT_EQ(some.size(), cloud.size());
  for (std::size_t s = 0; s < cloud.size(); ++s) {
    const auto expected = all.of(s), found = some.of(s);
    if (skip[s])
      EXPECT_TRUE(found.empty());
    else
      EXPECT_TRUE(std::equal(expected.begin(), expected.end(), found.begin(), found.end())) << "point " << s;
  }
  const Neighborhoods none =
      find_neighborhoods(cloud, {0.009f}, std::pmr::vector<std::uint8_t>(cloud.size(), 1));
  for (std::size_t s = 0; s < cloud.size(); ++s) EXPECT_TRUE(none.of(s).empty());
}

TEST(Neighborhoods, OrderWithinAListFollowsPositionsNotIndices) {
  const PointCloud cloud = random_cloud(400, {0, 0, 0}, {0.03f, 0.03f, 0.03f}, 11);
  PointCloud reversed;
  for (std::size_t i = cloud.size(); i-- > 0;) reversed.push_back(cloud.point(i));
  const Neighborhoods forward = find_neighborhoods(cloud, {0.009f}),
                      backward = find_neighborhoods(reversed, {0.009f});
  // Cells come in the same order; only points of one cell may swap.
  for (std::size_t s = 0; s < cloud.size(); ++s) {
    const auto a = forward.of(s), b = backward.of(cloud.size() - 1 - s);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
      const Eigen::Vector3f p = cloud.point(a[k]), q = reversed.point(b[k]);
      EXPECT_LE((p - q).cwiseAbs().maxCoeff(), 0.009f);
    }
  }
}

/// Cells next to each other differ by no more than one on each axis.
void expect_adjacent(const PointCloud& cloud, float cell_m, const std::pmr::vector<std::uint8_t>& skip = {}) {
  const CellOrder cells = order_by_cell(cloud, cell_m);
  const Neighborhoods neighborhoods = adjacent_points(cells, skip);
  ASSERT_EQ(neighborhoods.size(), cells.num_cells());
  for (std::size_t a = 0; a < cells.num_cells(); ++a) {
    std::pmr::vector<std::uint32_t> expected;
    for (std::uint32_t b = 0; b < cells.num_cells(); ++b)
      if ((cells.cell_of(cells.keys[a]) - cells.cell_of(cells.keys[b])).cwiseAbs().maxCoeff() <= 1)
        expected.push_back(b);
    if (!skip.empty() && skip[a] != 0) expected.clear();
    const auto list = neighborhoods.of(a);
    ASSERT_TRUE(std::ranges::equal(list, expected)) << "cell " << a << " of " << cells.num_cells();
  }
}

TEST(AdjacentPoints, OfOneCellAndOfNone) {
  expect_adjacent({}, 0.01f);
  expect_adjacent(random_cloud(1, {1, 1, 1}, {2, 2, 2}, 1), 0.01f);
}

TEST(AdjacentPoints, OfAFullBlockOfCells) {
  expect_adjacent(random_cloud(6000, {-0.04f, -0.04f, -0.04f}, {0.04f, 0.04f, 0.04f}, 2), 0.01f);
}

TEST(AdjacentPoints, OfRowsWithGapsAndOfScatteredCells) {
  for (std::uint32_t seed = 3; seed < 7; ++seed) {
    expect_adjacent(random_cloud(600, {-0.1f, -0.1f, -0.1f}, {0.1f, 0.1f, 0.1f}, seed), 0.01f);
    expect_adjacent(random_cloud(100, {-3, -2, -1}, {3, 2, 1}, seed), 0.01f);
    expect_adjacent(random_cloud(300, {-0.3f, -0.02f, 0}, {0.3f, 0.02f, 0}, seed), 0.01f);
  }
}

// The rows' places are found from cell to cell: few wanted ones are far apart.
TEST(AdjacentPoints, OfFewWantedCells) {
  const PointCloud cloud = random_cloud(3000, {-0.1f, -0.1f, -0.02f}, {0.1f, 0.1f, 0.02f}, 8);
  const std::size_t n = order_by_cell(cloud, 0.01f).num_cells();
  for (const std::size_t step : {2, 5, 37, 211}) {
    std::pmr::vector<std::uint8_t> skip(n);
    for (std::size_t i = 0; i < n; ++i) skip[i] = i % step != 0 ? 1 : 0;
    expect_adjacent(cloud, 0.01f, skip);
  }
}

}  // namespace
}  // namespace graspd

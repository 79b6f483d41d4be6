// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/cell_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "tests/support/clouds.hpp"

namespace graspd {
namespace {

void expect_sorted_and_complete(const PointCloud& cloud, const CellOrder& order) {
  ASSERT_EQ(order.points.size(), cloud.size());
  ASSERT_EQ(order.starts.size(), order.num_cells() + 1);
  EXPECT_EQ(order.starts.front(), 0u);
  EXPECT_EQ(order.starts.back(), cloud.size());
  std::pmr::vector<std::uint8_t> seen(cloud.size());
  for (std::size_t c = 0; c < order.num_cells(); ++c) {
    if (c > 0) {
      EXPECT_LT(order.keys[c - 1], order.keys[c]);
    }
    const auto points = order.cell(c);
    EXPECT_FALSE(points.empty());
    EXPECT_TRUE(std::is_sorted(points.begin(), points.end()))
        << "the sort is stable: indices ascend within a cell";
    for (const std::uint32_t i : points) ++seen.at(i);
  }
  EXPECT_TRUE(std::all_of(seen.begin(), seen.end(), [](int n) { return n == 1; }));
}

void expect_points_inside_their_cells(const PointCloud& cloud, const CellOrder& order) {
  for (std::size_t c = 0; c < order.num_cells(); ++c) {
    const Eigen::Vector3f corner = order.cell_of(order.keys[c]).cast<float>() * order.cell_m;
    for (const std::uint32_t i : order.cell(c)) {
      const Eigen::Vector3f in_cell = cloud.point(i) - corner;
      const float rounding = 4e-7f * cloud.point(i).cwiseAbs().maxCoeff();
      EXPECT_GE(in_cell.minCoeff(), -rounding);
      EXPECT_LE(in_cell.maxCoeff(), order.cell_m + rounding);
    }
  }
}

void expect_no_neighbour_wraps(const CellOrder& order) {
  std::map<std::int64_t, Eigen::Vector3i> occupied;
  for (const std::int64_t key : order.keys) occupied[key] = order.cell_of(key);
  for (const auto& [key, cell] : occupied)
    for (int dz = -1; dz <= 1; ++dz)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const Eigen::Vector3i neighbour = cell + Eigen::Vector3i(dx, dy, dz);
          const auto found = occupied.find(order.key(neighbour));
          if (found == occupied.end()) continue;
          EXPECT_EQ(found->second, neighbour) << "key " << found->first;
        }
}

/// Points brought into the order are in the same cells.
void expect_in_order(const PointCloud& cloud, const CellOrder& order) {
  const PointCloud sorted = points_at(cloud, order.points);
  ASSERT_EQ(sorted.size(), cloud.size());
  for (std::size_t k = 0; k < sorted.size(); ++k) ASSERT_EQ(sorted.point(k), cloud.point(order.points[k]));
  if (cloud.empty()) return;
  const CellOrder expected = order_by_cell(sorted, order.cell_m), found = in_order(order);
  EXPECT_EQ(found.points, expected.points);
  EXPECT_EQ(found.starts, expected.starts);
  EXPECT_EQ(found.keys, expected.keys);
}

void expect_all(const PointCloud& cloud, float cell_m) {
  const CellOrder order = order_by_cell(cloud, cell_m);
  expect_sorted_and_complete(cloud, order);
  expect_points_inside_their_cells(cloud, order);
  expect_no_neighbour_wraps(order);
  expect_in_order(cloud, order);
}

TEST(CellOrder, EmptyCloud) {
  const CellOrder order = order_by_cell({}, 0.01f);
  EXPECT_EQ(order.num_cells(), 0u);
  EXPECT_EQ(order.starts, RawVector<std::uint32_t>{0});
  expect_in_order({}, order);
}

TEST(CellOrder, OnePoint) {
  expect_all(random_cloud(1, {-1, -1, -1}, {1, 1, 1}, 1), 0.01f);
}

TEST(CellOrder, AllPointsEqual) {
  const PointCloud cloud = random_cloud(500, {0.3f, -0.2f, 0.1f}, {0.3f, -0.2f, 0.1f}, 1);
  EXPECT_EQ(order_by_cell(cloud, 0.01f).num_cells(), 1u);
  expect_all(cloud, 0.01f);
}

TEST(CellOrder, RandomCloudAcrossTheOrigin) {
  expect_all(random_cloud(3000, {-0.1f, -0.2f, -0.1f}, {0.1f, 0.1f, 0.2f}, 2), 0.02f);
}

TEST(CellOrder, FullGridHasNoRoomToWrap) {
  // Every cell of a small block is occupied: a neighbour that wrapped would meet another one.
  PointCloud cloud;
  for (int i = 0; i < 5 * 4 * 3; ++i)
    cloud.push_back(0.01f * (Eigen::Vector3f(static_cast<float>(i % 5), static_cast<float>(i / 5 % 4),
                                             static_cast<float>(i / 20)) +
                             Eigen::Vector3f::Constant(0.5f)));
  EXPECT_EQ(order_by_cell(cloud, 0.01f).num_cells(), 60u);
  expect_all(cloud, 0.01f);
}

TEST(CellOrder, PointsOnCellBorders) {
  expect_all(grid_patch({-0.05f, -0.05f, 0}, {0.01f, 0, 0}, {0, 0.01f, 0}, 11, 11), 0.01f);
}

TEST(CellOrder, FlatAndThinClouds) {
  expect_all(random_cloud(500, {-0.5f, 0, 0}, {0.5f, 0, 0}, 3), 0.01f);
  expect_all(random_cloud(500, {0, -0.5f, 0}, {0, 0.5f, 0}, 4), 0.01f);
  expect_all(random_cloud(500, {0, 0, -0.5f}, {0, 0, 0.5f}, 5), 0.01f);
}

TEST(CellOrder, WideCloudNeedsMoreThan32BitsOfKey) {
  const PointCloud cloud = random_cloud(2000, {-10, -10, -10}, {10, 10, 10}, 6);
  const CellOrder order = order_by_cell(cloud, 0.003f);
  EXPECT_GT(order.keys.back(), std::int64_t{1} << 36);
  expect_all(cloud, 0.003f);
}

/// More points than one thread sorts at a time: without runs in one cell, with short ones and with long ones.
TEST(CellOrder, LargeCloudsAreSortedAsByAStableSort) {
  constexpr std::size_t kNum = 150000;
  PointCloud scattered = random_cloud(kNum, {-0.3f, -0.3f, -0.3f}, {0.3f, 0.3f, 0.3f}, 7);
  PointCloud image = scattered;
  for (std::size_t i = 0; i < kNum; ++i) {
    image.x[i] = 1e-3f * static_cast<float>(i % 600) - 0.3f;
    image.y[i] = 1e-3f * static_cast<float>(i / 600) - 0.1f;
    image.z[i] = 0.5f + 0.2f * image.x[i];
  }
  for (const PointCloud* cloud : {&scattered, &image})
    for (const float cell_m : {0.003f, 0.05f}) {
      const CellOrder order = order_by_cell(*cloud, cell_m);
      const auto key = [&](std::uint32_t i) {
        return order.key({cell_index(cloud->x[i], 1 / cell_m), cell_index(cloud->y[i], 1 / cell_m),
                          cell_index(cloud->z[i], 1 / cell_m)});
      };
      RawVector<std::uint32_t> expected(kNum);
      std::iota(expected.begin(), expected.end(), 0u);
      std::stable_sort(expected.begin(), expected.end(),
                       [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
      ASSERT_EQ(order.points, expected);
      expect_in_order(*cloud, order);
      for (std::size_t c = 0; c < order.num_cells(); ++c)
        for (const std::uint32_t i : order.cell(c)) ASSERT_EQ(key(i), order.keys[c]);
      for (std::size_t c = 1; c < order.num_cells(); ++c) ASSERT_LT(order.keys[c - 1], order.keys[c]);
    }
}

/// A run has so many points at most, and its first point must be one that it has room for.
TEST(CellOrder, LongRunsAndFarPoints) {
  constexpr std::size_t kRoom = CellRun<std::uint32_t>::kFirstEnd;
  for (const std::size_t num : {std::size_t{100000}, kRoom + 100}) {
    PointCloud cloud;
    for (RawVector<float>* v : {&cloud.x, &cloud.y, &cloud.z}) v->assign(num, 0.5f);
    cloud.width = static_cast<int>(num);
    cloud.height = 1;
    for (std::size_t i = num / 2; i < num; ++i) cloud.x[i] = i % 3000 == 0 ? 0.5f : -0.5f;
    const CellOrder order = order_by_cell(cloud, 1);
    ASSERT_EQ(order.num_cells(), 2u);
    ASSERT_EQ(order.points.size(), num);
    for (std::size_t c = 0; c < 2; ++c) {
      const auto points = order.cell(c);
      ASSERT_TRUE(std::is_sorted(points.begin(), points.end()));
      ASSERT_TRUE(std::ranges::all_of(points, [&](std::uint32_t i) { return (cloud.x[i] > 0) == (c == 1); }));
    }
  }
}

}  // namespace
}  // namespace graspd

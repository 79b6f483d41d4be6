// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/container.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/clouds.hpp"

namespace graspd {
namespace {

constexpr float kSpacing = 0.004f, kHeight = 0.10f;

/// Two upright faces of 30 cm at right angles, seen from before the first one, and the level support z = 0.
struct Corner {
  PointCloud cloud;
  Labels labels;
  Support support;

  Corner() {
    add(grid_patch({0, 0, 0.01f}, {kSpacing, 0, 0}, {0, 0, kSpacing}, 75, 23));
    add(grid_patch({0, 0, 0.01f}, {0, kSpacing, 0}, {0, 0, kSpacing}, 75, 23));
  }
  void add(const PointCloud& face) {
    cloud = joined(cloud, face);
    labels.of_point.resize(cloud.size(), labels.num_labels++);
  }
  [[nodiscard]] bool has_walls() {
    cloud.viewpoint = {0.5f, -1, 1};
    support.plane = {Eigen::Vector3f::UnitZ(), 0};
    support.is_support.assign(cloud.size(), 0);
    const auto walls = find_container(cloud, build_segments(cloud, labels, kSpacing, {}), support, {});
    return std::any_of(walls.begin(), walls.end(), [](std::uint8_t is_wall) { return is_wall != 0; });
  }
};

TEST(Container, TwoThinWallsMakeOne) {
  EXPECT_TRUE(Corner().has_walls());
}

TEST(Container, SomethingLowInItDoesNotMatter) {
  Corner corner;
  corner.add(grid_patch({0.02f, 0.02f, 0.05f}, {kSpacing, 0, 0}, {0, kSpacing, 0}, 60, 60));
  EXPECT_TRUE(corner.has_walls());
}

TEST(Container, FacesOfWhatIsThickAreNoWalls) {
  Corner books;  // in rows along both faces
  books.add(grid_patch({0, 0, kHeight}, {kSpacing, 0, 0}, {0, kSpacing, 0}, 75, 25));
  books.add(grid_patch({0, 0.1f, kHeight}, {kSpacing, 0, 0}, {0, kSpacing, 0}, 25, 50));
  EXPECT_FALSE(books.has_walls());
}

}  // namespace
}  // namespace graspd

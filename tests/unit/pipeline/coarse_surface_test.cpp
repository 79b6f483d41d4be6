// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/coarse_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "service/pipeline/downsample.hpp"
#include "tests/support/clouds.hpp"
#include "tests/support/scene_gallery.hpp"

namespace graspd {
namespace {

constexpr float kLeaf = 0.006f;

std::pmr::vector<std::uint8_t> every(std::size_t step, std::size_t n) {
  std::pmr::vector<std::uint8_t> wanted(n);
  for (std::size_t i = 0; i < n; i += step) wanted[i] = 1;
  return wanted;
}

TEST(CoarseSurface, PreparesTheSameAsForAllPoints) {
  const PointCloud cloud = finite_points(render(three_objects()).cloud);
  CoarseSurface coarse(cloud, kLeaf);
  const PointCloud voxels = downsample(cloud, {kLeaf}).cloud;
  const Neighborhoods neighborhoods = adjacent_points(order_by_cell(voxels, kLeaf));
  const Normals normals = estimate_normals(voxels, neighborhoods);
  ASSERT_EQ(coarse.size(), voxels.size());
  for (const std::size_t step : {std::size_t{22}, std::size_t{3}, std::size_t{1}}) {
    const std::pmr::vector<std::uint8_t> wanted = every(step, coarse.size());
    EXPECT_FALSE(coarse.has(wanted));
    coarse.prepare(wanted);
    EXPECT_TRUE(coarse.has(wanted));
    const Neighborhoods some = coarse.neighborhoods(wanted);
    for (std::size_t i = 0; i < coarse.size(); ++i) {
      if (wanted[i] != 0) {
        ASSERT_EQ(coarse.normals().at(i), normals.at(i)) << i << " of every " << step;
        ASSERT_TRUE(std::ranges::equal(some.of(i), neighborhoods.of(i)));
      } else {
        ASSERT_TRUE(some.of(i).empty());
      }
    }
  }
}

TEST(CoarseSurface, WhatIsThereStaysAndTheRestIsAdded) {
  CoarseSurface coarse(finite_points(render(three_objects()).cloud), kLeaf);
  coarse.prepare(every(2, coarse.size()));
  EXPECT_TRUE(coarse.has(every(4, coarse.size())));
  EXPECT_FALSE(coarse.has(every(3, coarse.size())));
  EXPECT_EQ(coarse.normals().at(3), Eigen::Vector3f::Zero());
  const Eigen::Vector3f second = coarse.normals().at(2);
  coarse.prepare(every(3, coarse.size()));
  EXPECT_TRUE(coarse.has(every(3, coarse.size())));
  EXPECT_TRUE(coarse.has(every(2, coarse.size())));
  EXPECT_EQ(coarse.normals().at(2), second);
}

TEST(CoarseSurface, EmptyCloud) {
  CoarseSurface coarse({}, kLeaf);
  coarse.prepare({});
  EXPECT_EQ(coarse.size(), 0u);
}

}  // namespace
}  // namespace graspd

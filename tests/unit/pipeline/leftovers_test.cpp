// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/leftovers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "service/pipeline/edge_points.hpp"
#include "tests/support/clouds.hpp"
#include "tests/unit/pipeline/voxel_surfaces.hpp"

namespace graspd {
namespace {

constexpr float kMinPoints = 40;

/// The upper half of a cylinder along x.
PointCloud half_cylinder(float radius_m, float length_m, const Eigen::Vector3f& middle) {
  PointCloud cloud;
  const int around = static_cast<int>(std::numbers::pi_v<float> * radius_m / kTestLeaf);
  for (float x = -length_m / 2; x <= length_m / 2; x += kTestLeaf)
    for (int k = 0; k <= around; ++k) {
      const float turn = std::numbers::pi_v<float> * static_cast<float>(k) / static_cast<float>(around);
      cloud.push_back(middle + Eigen::Vector3f(x, radius_m * std::cos(turn), radius_m * std::sin(turn)));
    }
  cloud.viewpoint = {0, 0, 1};
  return cloud;
}

struct Grown {
  Labels before, after;
};

Grown grow(const PointCloud& cloud, const std::pmr::vector<std::uint8_t>& excluded = {}) {
  const SmoothnessConfig config;
  const Neighborhoods neighborhoods = find_neighborhoods(cloud, {kTestRadius});
  const Normals normals = estimate_normals(cloud, neighborhoods);
  Grown grown;
  grown.before = grow_regions(normals, neighborhoods, find_edge_points(normals, neighborhoods, config),
                              excluded, config);
  grown.after = grown.before;
  label_leftovers(cloud, neighborhoods, excluded, kMinPoints, grown.after);
  return grown;
}

TEST(Leftovers, NoCloudHasNone) {
  EXPECT_EQ(grow({}).after.num_labels, 0);
}

TEST(Leftovers, APenIsOneThingThoughNothingOfItIsSmooth) {
  const PointCloud pen = half_cylinder(0.005f, 0.13f, Eigen::Vector3f::Zero());
  const Grown grown = grow(pen);
  std::set<std::int32_t> labels(grown.after.of_point.begin(), grown.after.of_point.end());
  EXPECT_EQ(labels.size(), 1u);
  EXPECT_GE(*labels.begin(), 0);
  EXPECT_LT(*labels.begin(), grown.after.num_labels);
}

TEST(Leftovers, SurfacesKeepTheirLabelsBesideThem) {
  PointCloud cloud = grid_patch({-0.1f, 0.1f, 0}, {kTestLeaf, 0, 0}, {0, kTestLeaf, 0}, 60, 30);
  const std::size_t num_flat = cloud.size();
  cloud = joined(cloud, half_cylinder(0.005f, 0.13f, Eigen::Vector3f::Zero()));
  cloud.viewpoint = {0, 0, 1};
  const Grown grown = grow(cloud);
  for (std::size_t i = 0; i < num_flat; ++i) EXPECT_EQ(grown.after.of_point[i], grown.before.of_point[i]);
  EXPECT_NE(grown.after.of_point.back(), grown.after.of_point.front());
  EXPECT_GE(grown.after.of_point.back(), 0);
}

/// The upper half of a torus around z.
PointCloud half_ring(float radius_m, float thickness_m) {
  PointCloud cloud;
  const float pi = std::numbers::pi_v<float>;
  const int along = static_cast<int>(2 * pi * radius_m / kTestLeaf);
  const int around = static_cast<int>(pi * thickness_m / kTestLeaf);
  for (int i = 0; i < along; ++i)
    for (int k = 0; k <= around; ++k) {
      const float a = 2 * pi * static_cast<float>(i) / static_cast<float>(along);
      const float b = pi * static_cast<float>(k) / static_cast<float>(around);
      const float r = radius_m + thickness_m * std::cos(b);
      cloud.push_back({r * std::cos(a), r * std::sin(a), thickness_m * std::sin(b)});
    }
  cloud.viewpoint = {0, 0, 1};
  return cloud;
}

TEST(Leftovers, WhatStandsAloneIsOneThingAlsoIfItIsNotLong) {
  for (const PointCloud& cloud :
       {half_ring(0.04f, 0.005f), half_cylinder(0.005f, 0.02f, Eigen::Vector3f::Zero())}) {
    const Grown grown = grow(cloud);
    const std::set<std::int32_t> labels(grown.after.of_point.begin(), grown.after.of_point.end());
    EXPECT_EQ(labels.size(), 1u);
    EXPECT_GE(*labels.begin(), 0);
  }
}

TEST(Leftovers, AStubThatStandsOutOfASurfaceStaysWithout) {
  PointCloud cloud = grid_patch({-0.0185f, -0.09f, -0.045f}, {0, kTestLeaf, 0}, {0, 0, kTestLeaf}, 60, 30);
  cloud = joined(cloud, half_cylinder(0.005f, 0.031f, Eigen::Vector3f::Zero()));
  cloud.viewpoint = {1, 0, 1};
  const Grown grown = grow(cloud);
  const auto left = std::count(grown.before.of_point.begin(), grown.before.of_point.end(), -1);
  EXPECT_GE(static_cast<float>(left), kMinPoints) << "of the stub and where it stands";
  EXPECT_EQ(grown.after.of_point, grown.before.of_point);
}

TEST(Leftovers, WhatIsTooSmallOrExcludedStaysWithout) {
  const PointCloud stub = half_cylinder(0.005f, 0.01f, Eigen::Vector3f::Zero());
  const Grown grown = grow(stub);
  EXPECT_EQ(grown.after.of_point, grown.before.of_point);
  const PointCloud pen = half_cylinder(0.005f, 0.13f, Eigen::Vector3f::Zero());
  const std::pmr::vector<std::uint8_t> excluded(pen.size(), 1);
  for (const std::int32_t label : grow(pen, excluded).after.of_point) EXPECT_EQ(label, -1);
}

}  // namespace
}  // namespace graspd

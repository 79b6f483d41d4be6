// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/downsample.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <tuple>

#include "tests/support/clouds.hpp"

namespace graspd {
namespace {

using Voxel = std::tuple<int, int, int>;

constexpr float kLeaf = 0.003f;

/// Points well inside voxels (borders are a matter of rounding), about num_voxels of them occupied, around a
/// voxel.
PointCloud points_in_voxels(std::size_t n, int num_voxels_per_side, const Eigen::Vector3i& around,
                            std::uint32_t seed, std::vector<Voxel>& voxel_of_point) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> cell(-num_voxels_per_side / 2, num_voxels_per_side / 2);
  std::uniform_real_distribution<double> inside(0.02, 0.98);
  PointCloud cloud;
  for (std::size_t i = 0; i < n; ++i) {
    const int x = around.x() + cell(random), y = around.y() + cell(random), z = around.z() + cell(random);
    const double px = x + inside(random), py = y + inside(random), pz = z + inside(random);
    cloud.push_back((kLeaf * Eigen::Vector3d(px, py, pz)).cast<float>());
    voxel_of_point.emplace_back(x, y, z);
  }
  return cloud;
}

struct Mean {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int n = 0;
};

void expect_means(const PointCloud& cloud, const std::vector<Voxel>& voxels, double tolerance_m) {
  std::map<Voxel, Mean> oracle;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    Mean& mean = oracle[voxels[i]];
    mean.sum += cloud.point(i).cast<double>();
    ++mean.n;
  }
  const Downsampled result = downsample(cloud, {kLeaf});
  ASSERT_EQ(result.cloud.size(), oracle.size());
  ASSERT_EQ(result.voxel_of_point.size(), cloud.size());
  EXPECT_EQ(result.cloud.width, static_cast<int>(oracle.size()));
  EXPECT_EQ(result.cloud.height, 1);
  std::map<Voxel, std::uint32_t> index;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const std::uint32_t v = result.voxel_of_point[i];
    ASSERT_LT(v, result.cloud.size());
    EXPECT_EQ(index.try_emplace(voxels[i], v).first->second, v) << "points of one voxel share its index";
    const Mean& mean = oracle.at(voxels[i]);
    EXPECT_LE((result.cloud.point(v).cast<double>() - mean.sum / mean.n).norm(), tolerance_m);
  }
}

TEST(Downsample, EmptyCloud) {
  const Downsampled result = downsample({}, {kLeaf});
  EXPECT_TRUE(result.cloud.empty());
  EXPECT_TRUE(result.voxel_of_point.empty());
}

TEST(Downsample, MeansAgreeWithAMap) {
  std::vector<Voxel> voxels;
  const PointCloud cloud = points_in_voxels(5000, 12, {0, 0, 0}, 1, voxels);
  expect_means(cloud, voxels, 1e-8);
}

TEST(Downsample, MeansAgreeWithAMapFarFromTheOrigin) {
  std::vector<Voxel> voxels;
  const PointCloud cloud = points_in_voxels(3000, 8, {3000, -2500, 1000}, 2, voxels);
  expect_means(cloud, voxels, 1.5e-6);  // about one and a half steps of a float at 9 m
}

TEST(Downsample, DuplicatesDoNotMoveTheMean) {
  const PointCloud cloud = random_cloud(2000, {-0.03f, -0.03f, 0.5f}, {0.03f, 0.03f, 0.56f}, 3);
  const Downsampled once = downsample(cloud, {kLeaf}), twice = downsample(doubled(cloud), {kLeaf});
  ASSERT_EQ(once.cloud.size(), twice.cloud.size());
  for (std::size_t i = 0; i < once.cloud.size(); ++i)
    EXPECT_LT((once.cloud.point(i) - twice.cloud.point(i)).norm(), 2e-7f);
}

TEST(Downsample, AMillionEqualPointsStayWhereTheyAre) {
  const Eigen::Vector3f p(0.1234f, -0.5678f, 0.9f);
  const Downsampled result = downsample(random_cloud(1000000, p, p, 1), {kLeaf});
  ASSERT_EQ(result.cloud.size(), 1u);
  EXPECT_EQ(result.cloud.point(0), p);
}

TEST(Downsample, OrderOfThePointsMattersOnlyForRounding) {
  const PointCloud cloud = random_cloud(5000, {-0.02f, -0.02f, 0.5f}, {0.02f, 0.02f, 0.54f}, 4);
  const Downsampled a = downsample(cloud, {kLeaf}), b = downsample(shuffled(cloud, 5), {kLeaf});
  ASSERT_EQ(a.cloud.size(), b.cloud.size());
  for (std::size_t i = 0; i < a.cloud.size(); ++i)
    EXPECT_LT((a.cloud.point(i) - b.cloud.point(i)).norm(), 2e-7f);
}

TEST(Downsample, KeepsTheViewpoint) {
  PointCloud cloud = random_cloud(10, {0, 0, 0}, {1, 1, 1}, 6);
  cloud.viewpoint = {1, 2, 3};
  EXPECT_EQ(downsample(cloud, {kLeaf}).cloud.viewpoint, cloud.viewpoint);
}

}  // namespace
}  // namespace graspd

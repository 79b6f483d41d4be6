// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/smoothing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/clouds.hpp"

namespace graspd {
namespace {

PointCloud smoothed(const PointCloud& cloud, float radius_m = 0.009f) {
  const Neighborhoods near = find_neighborhoods(cloud, {radius_m});
  return smooth(cloud, estimate_normals(cloud, near), near);
}

double rms_about(const PointCloud& cloud, float z) {
  double sum = 0;
  for (const float value : cloud.z) sum += (value - z) * (value - z);
  return std::sqrt(sum / static_cast<double>(cloud.size()));
}

PointCloud noisy_plane() {
  PointCloud cloud = grid_patch({-0.1f, -0.1f, 0.8f}, {0.003f, 0, 0}, {0, 0.003f, 0}, 66, 66);
  return with_range_noise(cloud, 0.001f, 1);
}

TEST(SmoothingIterations, FollowTheScatter) {
  SmoothingConfig config;
  config.from_scatter_m = 0.002f;
  config.scatter_step_m = 0.0005f;
  const auto iterations = [&](float scatter_m) { return smoothing_iterations(config, scatter_m); };
  EXPECT_EQ(iterations(0), 0) << "no support";
  EXPECT_EQ(iterations(0.0019f), 0);
  EXPECT_EQ(iterations(0.0021f), 1);
  EXPECT_EQ(iterations(0.0026f), 2);
  EXPECT_EQ(iterations(0.0036f), 4);
  EXPECT_EQ(iterations(1e6f), 4);
  config.iterations = 2;
  EXPECT_EQ(iterations(0.001f), 2) << "at least";
  EXPECT_EQ(iterations(0.0021f), 2);
  EXPECT_EQ(iterations(0.0031f), 3);
  config.iterations = 9;
  EXPECT_EQ(iterations(0.1f), 9);
  config.iterations = 0;
  config.from_scatter_m = 0;
  EXPECT_EQ(iterations(0.1f), 0) << "never";
}

TEST(Smoothing, ANoisyPlaneGetsFlatter) {
  PointCloud cloud = noisy_plane();
  double rms = rms_about(cloud, 0.8f);
  for (int round = 0; round < 3; ++round) {
    cloud = smoothed(cloud);
    const double flatter = rms_about(cloud, 0.8f);
    EXPECT_LT(flatter, round == 0 ? 0.4 * rms : 0.9 * rms);
    rms = flatter;
  }
}

TEST(Smoothing, AnExactPlaneStays) {
  const PointCloud cloud = grid_patch({-0.1f, -0.1f, 0.8f}, {0.003f, 0, 0.001f}, {0, 0.003f, 0}, 50, 50);
  const PointCloud after = smoothed(cloud);
  for (std::size_t i = 0; i < cloud.size(); ++i) EXPECT_LT((after.point(i) - cloud.point(i)).norm(), 1e-6f);
}

TEST(Smoothing, EdgesStay) {
  const Eigen::Vector3f min(-0.03f, -0.03f, 0.5f), max(0.03f, 0.03f, 0.56f), center = 0.5f * (min + max);
  PointCloud cloud = box_shell(min, max, 0.003f);
  for (int round = 0; round < 5; ++round) cloud = smoothed(cloud);
  float worst = 0, sum = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const float moved_in = std::abs((cloud.point(i) - center).cwiseAbs().maxCoeff() - 0.03f);
    worst = std::max(worst, moved_in);
    sum += moved_in;
  }
  EXPECT_LT(worst, 0.003f) << "no more than a voxel";
  EXPECT_LT(sum / static_cast<float>(cloud.size()), 0.0005f);
}

TEST(Smoothing, PointsMoveLessThanTheRadius) {
  const PointCloud cloud = random_cloud(3000, {0, 0, 0.5f}, {0.1f, 0.1f, 0.55f}, 2);
  const PointCloud after = smoothed(cloud);
  ASSERT_EQ(after.size(), cloud.size());
  EXPECT_EQ(after.viewpoint, cloud.viewpoint);
  for (std::size_t i = 0; i < cloud.size(); ++i) EXPECT_LT((after.point(i) - cloud.point(i)).norm(), 0.009f);
}

TEST(Smoothing, PointsWithoutANormalStay) {
  const PointCloud line = grid_patch({0, 0, 0.5f}, {0.003f, 0, 0}, {0, 0, 0}, 50, 1);
  const PointCloud after = smoothed(line);
  for (std::size_t i = 0; i < line.size(); ++i) EXPECT_EQ(after.point(i), line.point(i));
  EXPECT_TRUE(smoothed({}).empty());
}

}  // namespace
}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/depth_map.hpp"

#include <gtest/gtest.h>

#include "service/pipeline/workspace_filter.hpp"
#include "tests/support/clouds.hpp"
#include "tests/support/scene_gallery.hpp"

namespace graspd {
namespace {

constexpr float kMargin = 0.005f;

/// A wall of 0.2 m x 0.2 m, 1 m before the sensor at the origin, before a larger one at 1.5 m.
PointCloud two_walls() {
  const PointCloud front = grid_patch({-0.1f, -0.1f, 1}, {0.002f, 0, 0}, {0, 0.002f, 0}, 101, 101);
  const PointCloud back = grid_patch({-0.6f, -0.6f, 1.5f}, {0.003f, 0, 0}, {0, 0.003f, 0}, 401, 401);
  PointCloud cloud;
  // What the front wall hides was not measured.
  for (std::size_t i = 0; i < back.size(); ++i)
    if (back.point(i).head<2>().cwiseAbs().maxCoeff() > 0.152f) cloud.push_back(back.point(i));
  return joined(cloud, front);
}

TEST(DepthMap, NothingIsHiddenWithoutPoints) {
  const DepthMap map{PointCloud{}};
  EXPECT_EQ(map.hider({0, 0, 1}, kMargin), DepthMap::kFree);
}

TEST(DepthMap, AWallHidesWhatIsBehindItAndNothingBefore) {
  const PointCloud cloud = two_walls();
  const DepthMap map(cloud);
  for (float x = -0.09f; x < 0.09f; x += 0.013f)
    for (float y = -0.09f; y < 0.09f; y += 0.017f) {
      const std::int32_t hider = map.hider({1.2f * x, 1.2f * y, 1.2f}, kMargin);
      ASSERT_NE(hider, DepthMap::kFree) << x << " " << y;
      EXPECT_LT((cloud.point(static_cast<std::size_t>(hider)) - Eigen::Vector3f(x, y, 1)).norm(), 0.012f);
      EXPECT_EQ(map.hider({0.8f * x, 0.8f * y, 0.8f}, kMargin), DepthMap::kFree);
      EXPECT_EQ(map.hider({x, y, 1.0f}, kMargin), DepthMap::kFree) << "the surface does not hide itself";
      EXPECT_NE(map.hider({1.6f * x, 1.6f * y, 1.6f}, kMargin), DepthMap::kFree);
    }
}

TEST(DepthMap, FreeBesideAWall) {
  const DepthMap map(two_walls());
  for (const float x : {-0.16f, -0.13f, 0.13f, 0.16f})
    EXPECT_EQ(map.hider({1.2f * x, 0, 1.2f}, kMargin), DepthMap::kFree) << x;
}

TEST(DepthMap, TheMarginDecidesJustBehindASurface) {
  const DepthMap map(two_walls());
  EXPECT_EQ(map.hider({0, 0, 1.004f}, kMargin), DepthMap::kFree);
  EXPECT_NE(map.hider({0, 0, 1.010f}, kMargin), DepthMap::kFree);
}

TEST(DepthMap, NothingIsKnownOutsideTheImageAndBehindTheSensor) {
  const DepthMap map(two_walls());
  for (const Eigen::Vector3f& p :
       {Eigen::Vector3f(2, 0, 1), Eigen::Vector3f(0, -3, 1), Eigen::Vector3f(0, 0, -1),
        Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(5, 5, 0)})
    EXPECT_EQ(map.hider(p, kMargin), DepthMap::kFree) << p.transpose();
}

TEST(DepthMap, TheSameFromOrganizedAndUnorganizedCloudsAndFromAnyPose) {
  const AnalyticScene scene = bottle_beside_box();
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::AngleAxisd(2.1, Eigen::Vector3d(1, -1, 0.4).normalized()).toRotationMatrix();
  T.translation() = Eigen::Vector3d(1, 2, 3);
  const PointCloud here = finite_points(render(scene).cloud),
                   there = finite_points(render(moved(scene, T)).cloud);
  const DepthMap map(here), other(shuffled(here, 1)), away(there);
  int hidden = 0, differ = 0, total = 0;
  for (float x = -0.15f; x < 0.15f; x += 0.01f)
    for (float y = -0.15f; y < 0.15f; y += 0.01f)
      for (float z = 0.01f; z < 0.2f; z += 0.02f) {
        const Eigen::Vector3f p(x, y, z);
        const bool is_hidden = map.hider(p, kMargin) != DepthMap::kFree;
        EXPECT_EQ(is_hidden, other.hider(p, kMargin) != DepthMap::kFree);
        differ += is_hidden != (away.hider(T.cast<float>() * p, kMargin) != DepthMap::kFree) ? 1 : 0;
        hidden += is_hidden ? 1 : 0;
        ++total;
      }
  EXPECT_GT(hidden, total / 20);
  // Pixels fall elsewhere in another frame: what lies on a silhouette may change.
  EXPECT_LT(differ, total / 100);
}

TEST(DepthMap, TellsWhatTheRaysOfASceneMet) {
  const AnalyticScene scene = three_objects();
  const PointCloud cloud = finite_points(render(scene).cloud);
  const DepthMap map(cloud);
  const Eigen::Vector3d eye = cloud.viewpoint.cast<double>();
  int wrong = 0, total = 0;
  for (double x = -0.15; x < 0.16; x += 0.006)
    for (double y = -0.1; y < 0.12; y += 0.006)
      for (const double z : {0.02, 0.05, 0.09}) {
        const Eigen::Vector3d p(x, y, z);
        double nearest = 1e9;
        for (const AnalyticSolid& solid : scene.solids) {
          const auto chord = intersect(solid, eye, (p - eye).normalized());
          if (chord && chord->enter > 0) nearest = std::min(nearest, chord->enter);
        }
        const double behind = (p - eye).norm() - nearest;
        if (std::abs(behind - kMargin) < 0.004) continue;
        ++total;
        wrong += (map.hider(p.cast<float>(), kMargin) != DepthMap::kFree) != (behind > kMargin) ? 1 : 0;
      }
  // One pixel of the map to both sides of the silhouettes is not determined.
  EXPECT_LT(wrong, total / 40) << "of " << total;
}

TEST(DepthMap, DegenerateClouds) {
  PointCloud around = sphere_shell({0, 0, 0}, 1, 500);  // as many points before the sensor as behind it
  EXPECT_EQ(DepthMap(around).hider({0, 0, 2}, kMargin), DepthMap::kFree);
  const DepthMap one(random_cloud(1, {0, 0, 1}, {0, 0, 1}, 1));
  EXPECT_EQ(one.hider({1, 1, 2}, kMargin), DepthMap::kFree);
  PointCloud at_sensor = random_cloud(5, {0, 0, 0}, {0, 0, 0}, 1);
  EXPECT_EQ(DepthMap(at_sensor).hider({0, 0, 1}, kMargin), DepthMap::kFree);
  const DepthMap line(grid_patch({-0.5f, 0, 1}, {0.01f, 0, 0}, {0, 0, 0}, 100, 1));
  EXPECT_EQ(line.hider({0, 0.5f, 1}, kMargin), DepthMap::kFree);
}

TEST(DepthMap, ARayCoversMoreFartherAway) {
  const DepthMap map(two_walls());
  EXPECT_NEAR(map.ray_area({0, 0, 1.5f}) / map.ray_area({0, 0, 1}), 2.25f, 1e-3f);
  EXPECT_GT(map.ray_area({0, 0, 1}), 0);
}

}  // namespace
}  // namespace graspd

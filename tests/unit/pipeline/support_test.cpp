// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/support.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "service/pipeline/downsample.hpp"
#include "tests/support/clouds.hpp"
#include "tests/support/scene_gallery.hpp"
#include "tests/unit/pipeline/voxel_surfaces.hpp"

namespace graspd {
namespace {

std::optional<Support> support_of(const VoxelSurfaces& s) {
  return find_support(s.cloud, {});
}

/// The plane with this normal through this point.
void expect_plane(const std::optional<Support>& support, const Eigen::Vector3d& normal,
                  const Eigen::Vector3d& point) {
  ASSERT_TRUE(support);
  EXPECT_NEAR(support->plane.normal.norm(), 1, 1e-5);
  EXPECT_GT(support->plane.normal.cast<double>().dot(normal), std::cos(0.3 * std::numbers::pi / 180));
  EXPECT_NEAR(support->plane.height(point.cast<float>()), 0, 0.001);
}

/// Points of the solid are its own, those of others that rise well above it are not.
void expect_points(const VoxelSurfaces& s, const Support& support, int solid, double rise_m) {
  for (std::size_t i = 0; i < s.cloud.size(); ++i) {
    const float height = support.plane.height(s.cloud.point(i));
    if (s.solid[i] == solid && height < 0.001f) {
      EXPECT_EQ(support.is_support[i], 1) << s.cloud.point(i).transpose();
    }
    if (height > rise_m) {
      EXPECT_EQ(support.is_support[i], 0) << s.cloud.point(i).transpose();
    }
  }
}

TEST(Support, Table) {
  const VoxelSurfaces s = voxel_surfaces(render(three_objects()));
  const auto support = support_of(s);
  expect_plane(support, Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero());
  expect_points(s, *support, 0, 0.010);
}

TEST(Support, TiltedCamerasAndFrames) {
  for (int k = 0; k < 6; ++k) {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.linear() =
        Eigen::AngleAxisd(0.9 * k, Eigen::Vector3d(1, k - 2.5, 0.3 * k).normalized()).toRotationMatrix();
    T.translation() = Eigen::Vector3d(0.3 * k, -0.5, 1);
    const VoxelSurfaces s = voxel_surfaces(render(moved(three_objects(), T)));
    const auto support = support_of(s);
    expect_plane(support, T.linear().col(2), T.translation());
    if (support) expect_points(s, *support, 0, 0.010);
  }
}

TEST(Support, CameraFromStraightAboveAndFromLow) {
  for (const Eigen::Vector3d& eye : {Eigen::Vector3d(0, 0, 0.8), Eigen::Vector3d(0, -0.7, 0.25)}) {
    AnalyticScene scene = three_objects();
    scene.camera.T_scene_camera = looking_at(eye, {0, 0, 0.02});
    const VoxelSurfaces s = voxel_surfaces(render(scene));
    expect_plane(support_of(s), Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero());
  }
}

TEST(Support, SurvivesNoise) {
  RenderedScene rendered = render(three_objects());
  rendered.cloud = with_range_noise(rendered.cloud, 0.001f, 1);
  const auto support = support_of(voxel_surfaces(rendered));
  expect_plane(support, Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero());
  EXPECT_GT(support->sigma_m, 0.0002f);
  EXPECT_LT(support->sigma_m, 0.002f);
}

TEST(Support, NoneWithoutAPlane) {
  EXPECT_FALSE(find_support({}, {}));
  const PointCloud ball = sphere_shell({0, 0, 0.5f}, 0.06f, 4000);
  EXPECT_FALSE(find_support(ball, {}));
}

TEST(Support, NoneWhereThePlaneIsTooSmall) {
  // 0.1 m x 0.1 m is less than the 0.03 m2 asked for.
  PointCloud patch = grid_patch({0, 0, 0}, {0.003f, 0, 0}, {0, 0.003f, 0}, 33, 33);
  patch.viewpoint = {0, 0, 1};
  EXPECT_FALSE(find_support(patch, {}));
  SupportConfig smaller;
  smaller.min_area_m2 = 0.005f;
  EXPECT_FALSE(find_support(patch, smaller)) << "less than four times as much, and nothing on it";
  const PointCloud thing = box_shell({0.02f, 0.02f, 0.005f}, {0.08f, 0.08f, 0.07f}, 0.003f);
  EXPECT_TRUE(find_support(joined(patch, thing), smaller));
  smaller.min_area_m2 = 0.002f;
  EXPECT_TRUE(find_support(patch, smaller));
}

TEST(Support, AnObjectsFaceIsNoneWhereTheSupportWasCutAway) {
  // Its top is 0.25 m x 0.2 m.
  const AnalyticScene scene =
      on_table({standing_box(0, 0, {0.25, 0.2, 0.1}), standing_box(0.2, 0, {0.04, 0.1, 0.05}),
                standing_box(0.08, 0, {0.05, 0.05, 0.18})});
  const auto without_table = [&](std::size_t num_boxes) {
    AnalyticScene some = scene;
    some.solids.resize(1 + num_boxes);
    const RenderedScene rendered = render(some);
    PointCloud cloud;
    cloud.viewpoint = rendered.cloud.viewpoint;
    for (std::size_t i = 0; i < rendered.cloud.size(); ++i)
      if (rendered.solid_of_point[i] > 0) cloud.push_back(rendered.cloud.point(i));
    return cloud;
  };
  EXPECT_FALSE(find_support(without_table(1), {}));
  EXPECT_FALSE(find_support(without_table(2), {})) << "what stands beside it is not on it";
  expect_plane(find_support(without_table(3), {}), Eigen::Vector3d::UnitZ(), {0, 0, 0.1});
}

TEST(Support, NoneWhenNotAskedFor) {
  const VoxelSurfaces s = voxel_surfaces(render(three_objects()));
  SupportConfig off;
  off.enabled = false;
  EXPECT_FALSE(find_support(s.cloud, off));
}

TEST(Support, FloorOfABin) {
  // 0.4 m x 0.3 m inside, walls of 10 mm and 0.12 m high.
  const VoxelSurfaces s = voxel_surfaces(render(on_table(
      {standing_box(0, -0.155, {0.42, 0.01, 0.12}), standing_box(0, 0.155, {0.42, 0.01, 0.12}),
       standing_box(-0.205, 0, {0.01, 0.3, 0.12}), standing_box(0.205, 0, {0.01, 0.3, 0.12}),
       standing_box(0.05, 0.02, {0.05, 0.10, 0.06}, 0.3), standing_cylinder(-0.08, 0, 0.03, 0.09)})));
  const auto support = support_of(s);
  expect_plane(support, Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero());
  expect_points(s, *support, 0, 0.010);
}

TEST(Support, LargestOfSeveralPlanes) {
  // A table, a wall behind it, and a large box: three planes that face the camera.
  const VoxelSurfaces s = voxel_surfaces(
      render(on_table({standing_box(0, 0.3, {1, 0.05, 0.5}), standing_box(-0.1, 0.05, {0.15, 0.15, 0.12})})));
  expect_plane(support_of(s), Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero());
}

/// With voxels so fine that there are too many for each to have a normal before it is needed.
SupportConfig fine(const PointCloud& cloud, float leaf_size_m) {
  EXPECT_GT(downsample(cloud, {leaf_size_m}).cloud.size(), 10000u);
  SupportConfig config;
  config.leaf_size_m = leaf_size_m;
  return config;
}

TEST(Support, OfManyPoints) {
  const VoxelSurfaces s = voxel_surfaces(render(three_objects()));
  const auto support = find_support(s.cloud, fine(s.cloud, 0.004f));
  expect_plane(support, Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero());
  expect_points(s, *support, 0, 0.010);
}

/// A table with a box on it, so far above a floor, and other solids.
AnalyticScene table_over_floor(double width, double depth, double height,
                               std::vector<AnalyticSolid> others = {}) {
  std::vector<AnalyticSolid> solids{standing_box(0, 0, {width, depth, 0.03}),
                                    standing_box(0.05, 0, {0.05, 0.1, 0.08})};
  solids.insert(solids.end(), others.begin(), others.end());
  AnalyticScene scene = on_table(solids);
  scene.solids[1].T_scene_solid.translation().z() = -0.015;
  scene.solids[0].T_scene_solid.translation().z() = -height;
  return scene;
}

TEST(Support, TheTableRatherThanTheLargerFloorBelow) {
  // A table of 0.5 m x 0.4 m, 0.5 m above a floor of which more is seen.
  AnalyticScene scene = table_over_floor(0.5, 0.4, 0.5);
  scene.camera = {looking_at({0, -0.6, 0.9}, {0, 0, 0}), 320, 240, 230};
  const VoxelSurfaces s = voxel_surfaces(render(scene));
  for (const SupportConfig& config : {SupportConfig{}, fine(s.cloud, 0.006f)}) {
    const auto support = find_support(s.cloud, config);
    expect_plane(support, Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero());
    expect_points(s, *support, 1, 0.010);
  }
}

TEST(Support, TheTableBeforeAFloorTooFarToBeMeasuredWell) {
  // From 30 degrees above the table more of the floor behind it is seen than of the table: all of it is
  // behind the table's plane, and too rough for a plane of its own.
  AnalyticScene scene = table_over_floor(0.8, 0.5, 0.7);
  scene.camera = {looking_at({0, -0.75, 0.43}, {0, 0, 0}), 320, 240, 260};
  RenderedScene rendered = render(scene);
  // It grows with the square of the distance, as that of cameras with a baseline does.
  const auto sigma_m = [](float range_m) { return 0.004f * range_m * range_m; };
  rendered.cloud = with_range_noise(finite_points(rendered.cloud), sigma_m, 1);
  const auto below = static_cast<std::size_t>(
      std::count_if(rendered.cloud.z.begin(), rendered.cloud.z.end(), [&](float z) { return z < -0.3f; }));
  EXPECT_GT(2 * below, rendered.cloud.size());
  const auto support = find_support(rendered.cloud, {});
  expect_plane(support, Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero());
}

TEST(Support, TheTableBeforeALargerWallFartherAway) {
  // A table of 0.8 m x 0.5 m with a box on it, and a wall of 3 m x 2 m that stands 1 m behind it.
  AnalyticScene scene = table_over_floor(0.8, 0.5, 0.7, {standing_box(0, 1.5, {3, 0.1, 2})});
  scene.camera = {looking_at({0, -0.8, 0.4}, {0, 0.2, 0}), 320, 240, 260};
  const PointCloud cloud = finite_points(render(scene).cloud);
  expect_plane(find_support(cloud, {}), Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero());
}

TEST(Support, SeveralLevelsWithThingsOnThem) {
  const VoxelSurfaces s = voxel_surfaces(render(block_on_table()));
  const auto support = support_of(s);
  ASSERT_TRUE(support);
  ASSERT_EQ(support->levels.size(), 2u);
  EXPECT_NEAR(support->levels[0].plane.height({0, 0, 0}), 0, 0.001f);
  EXPECT_NEAR(support->levels[1].plane.height({0, 0, 0.12f}), 0, 0.001f);
  EXPECT_TRUE(support->levels[1].is_solid);
  EXPECT_EQ(&support->lowest_plane(), &support->levels[0].plane);
  for (std::size_t i = 0; i < s.cloud.size(); ++i) {
    const float z = s.cloud.z[i];
    // Not the faces of the things at the height of the block's top, nor its own front below that.
    if (s.solid[i] > 1 && std::abs(z - 0.12f) > 0.01f && z > 0.01f) {
      EXPECT_EQ(support->is_support[i], 0) << s.cloud.point(i).transpose();
    }
    if (z < 0.001f || (s.solid[i] == 1 && z > 0.119f)) {
      EXPECT_EQ(support->is_support[i], 1) << s.cloud.point(i).transpose();
    }
  }
}

TEST(Support, AWideThingWithNothingOnItIsNoLevelAndANarrowOneNeither) {
  AnalyticScene bare = block_on_table();
  bare.solids.erase(bare.solids.begin() + 2);
  AnalyticScene narrow = block_on_table();
  narrow.solids[1].half.y() = 0.08;
  for (const AnalyticScene& scene : {bare, narrow, three_objects()}) {
    const auto support = support_of(voxel_surfaces(render(scene)));
    expect_plane(support, Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero());
    EXPECT_TRUE(support->levels.empty());
  }
}

TEST(Support, TheBoardsOfAShelf) {
  for (const float sigma_m : {0.0f, 0.0015f}) {
    RenderedScene rendered = render(shelf());
    if (sigma_m > 0) rendered.cloud = with_range_noise(rendered.cloud, sigma_m, 1);
    const auto support = support_of(voxel_surfaces(rendered));
    ASSERT_TRUE(support);
    EXPECT_GT(support->plane.normal.z(), 0.99f);
    ASSERT_EQ(support->levels.size(), 2u);
    EXPECT_NEAR(support->levels[0].plane.height({0, 0, 0}), 0, 0.002f);
    EXPECT_NEAR(support->levels[1].plane.height({0, 0, 0.32f}), 0, 0.002f);
    EXPECT_FALSE(support->levels[1].is_solid) << "things stand under it";
  }
}

/// What a camera sees of a scene, in its optical frame.
PointCloud optical_view(const AnalyticScene& scene) {
  PointCloud cloud =
      moved(finite_points(render(scene).cloud), scene.camera.T_scene_camera.inverse().cast<float>());
  EXPECT_TRUE(cloud.viewpoint.isZero(1e-6f));
  cloud.viewpoint.setZero();
  return cloud;
}

TEST(Support, AnUprightCameraSeesAWallFaceDown) {
  // From 14 degrees above more is seen of the wall than of what is level before it.
  AnalyticScene scene = on_table({standing_box(0, 0.1, {2, 0.02, 1.2})});
  scene.camera = {looking_at({0, -0.9, 0.35}, {0, 0, 0.12}), 320, 240, 400};
  const auto support = find_support(optical_view(scene), {});
  ASSERT_TRUE(support);
  EXPECT_LT(support->plane.normal.y(), -0.8f) << "the table";
}

TEST(Support, ACameraOnItsHeadSeesATableFaceDown) {
  AnalyticScene scene = three_objects();
  scene.camera.T_scene_camera.rotate(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitZ()));
  const auto support = find_support(optical_view(scene), {});
  ASSERT_TRUE(support);
  EXPECT_GT(support->plane.normal.y(), 0.3f);
  EXPECT_NEAR(support->plane.height(scene.camera.T_scene_camera.inverse().translation().cast<float>()), 0,
              0.001f);
}

TEST(Support, WhatIsSeenThroughIsNone) {
  // The tops of blocks in rows, 6 cm wide and 4 cm apart, of which more is seen than of the table between
  // them.
  PointCloud cloud;
  cloud.viewpoint = {0, 0, 10};
  const PointCloud places = grid_patch({-0.3f, -0.3f, 0}, {0.006f, 0, 0}, {0, 0.006f, 0}, 100, 100);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const bool is_top = i % 10 < 6;
    cloud.push_back(places.point(i) + (is_top ? 0.08f : 0) * Eigen::Vector3f::UnitZ());
  }
  SupportConfig config;
  config.leaf_size_m = 0.006f;
  const auto support = find_support(cloud, config);
  ASSERT_TRUE(support);
  EXPECT_NEAR(support->plane.height({0, 0, 0}), 0, 0.001f) << "not the tops";
}

TEST(Support, TheSameCloudGivesTheSamePlane) {
  const VoxelSurfaces s = voxel_surfaces(render(three_objects()));
  const auto a = support_of(s), b = support_of(s);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->plane.normal, b->plane.normal);
  EXPECT_EQ(a->plane.offset_m, b->plane.offset_m);
  EXPECT_EQ(a->is_support, b->is_support);
}

TEST(Support, ThicknessGrowsWithDistanceAndScatter) {
  const SupportConfig config;
  const Eigen::Vector3f eye(0, 0, 0);
  EXPECT_FLOAT_EQ(support_thickness({0, 0, 0.5f}, eye, 0, config), config.min_thickness_m);
  EXPECT_FLOAT_EQ(support_thickness({0, 0, 0.8f}, eye, 0, config), config.min_thickness_m);
  EXPECT_NEAR(support_thickness({0, 0, 1.8f}, eye, 0, config),
              config.min_thickness_m + config.thickness_per_m, 1e-6);
  EXPECT_NEAR(support_thickness({0, 0, 0.5f}, eye, 0.004f, config), 0.014f, 1e-6);
}

}  // namespace
}  // namespace graspd

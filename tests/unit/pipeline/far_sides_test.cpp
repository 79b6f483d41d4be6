// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/far_sides.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "service/pipeline/detect_handles.hpp"
#include "service/pipeline/surfaces.hpp"
#include "tests/support/clouds.hpp"
#include "tests/support/handle_truth.hpp"
#include "tests/support/scene_gallery.hpp"

namespace graspd {
namespace {

Surfaces surfaces_of(const PointCloud& cloud) {
  return find_surfaces(cloud, {}, [](std::string_view) {});
}

PointCloud cloud_of(const AnalyticScene& scene) {
  return finite_points(render(scene).cloud);
}

TEST(FarSides, OfNothingAndOfBoxesThereAreNone) {
  EXPECT_TRUE(find_far_sides({}, DepthMap(PointCloud{})).cloud.empty());
  const PointCloud cloud = cloud_of(box_on_table());
  EXPECT_TRUE(find_far_sides(surfaces_of(cloud), DepthMap(cloud)).cloud.empty());
}

TEST(FarSides, AreTheHiddenWallsOfRoundObjects) {
  for (const AnalyticScene& scene : {cylinder_on_table(), lying_cylinder_on_table()}) {
    const PointCloud cloud = cloud_of(scene);
    const Surfaces surfaces = surfaces_of(cloud);
    const FarSides sides = find_far_sides(surfaces, DepthMap(cloud));
    ASSERT_GT(sides.cloud.size(), 100u);
    ASSERT_EQ(sides.normals.size(), sides.cloud.size());
    ASSERT_EQ(sides.voxel_of_point.size(), cloud.size() + sides.cloud.size());
    for (std::size_t i = cloud.size(); i < sides.voxel_of_point.size(); ++i)
      EXPECT_GE(surfaces.objects.of_point[sides.voxel_of_point[i]], 0) << "an object's";
    const AnalyticSolid& solid = scene.solids[1];
    for (std::size_t i = 0; i < sides.cloud.size(); ++i) {
      const Eigen::Vector3d p = sides.cloud.point(i).cast<double>(), n = sides.normals.at(i).cast<double>();
      EXPECT_LT(std::abs(signed_distance(solid, p)), 0.002);
      EXPECT_NEAR(signed_distance(solid, p + 0.005 * n), 0.005, 0.002) << "the normal points outward";
      const Eigen::Vector3d sight = p - scene.camera.T_scene_camera.translation();
      EXPECT_GT(n.dot(sight.normalized()), -0.1) << "it faces away";
    }
  }
}

TEST(FarSides, FindTheirPointsInABox) {
  const PointCloud cloud = cloud_of(cylinder_on_table());
  const FarSides sides = find_far_sides(surfaces_of(cloud), DepthMap(cloud));
  ASSERT_GT(sides.cloud.size(), 100u);
  const Eigen::Matrix3f rotation(Eigen::AngleAxisf(0.7f, Eigen::Vector3f(1, 2, 3).normalized()));
  const Eigen::Vector3f min(-0.01f, -0.03f, -0.04f), max(0.01f, 0.05f, 0.04f);
  for (std::size_t k = 0; k < sides.cloud.size(); k += 17) {
    const BoxTest box = box_test(sides.cloud.point(k), rotation, min, max);
    LocalPoints expected, found;
    const PointSpan all{0, static_cast<std::uint32_t>(sides.cloud.size())};
    expected.add_inside(box, sides.padded.all(), {&all, 1});
    sides.add_inside(box, 1000, found);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found.index[i], expected.index[i] + 1000);
    const auto n = static_cast<int>(expected.size());
    EXPECT_TRUE(sides.has_more(box, n - 1));
    EXPECT_FALSE(sides.has_more(box, n));
  }
}

TEST(FarSides, ABodyALittleTooWideIsOneStill) {
  // The sensor sees past its limbs then; past what is much too wide it sees more.
  const auto standing = [](double radius) {
    return cloud_of(on_table({standing_cylinder(0, 0, radius, 0.12)}));
  };
  for (const double radius : {0.030, 0.036}) {
    SCOPED_TRACE(radius);
    const Surfaces surfaces = surfaces_of(standing(radius));
    for (const double too_wide : {0.0, 0.001, 0.002})
      EXPECT_GT(find_far_sides(surfaces, DepthMap(standing(radius - too_wide))).cloud.size(), 100u)
          << too_wide;
    EXPECT_TRUE(find_far_sides(surfaces, DepthMap(standing(radius - 0.012))).cloud.empty());
  }
}

TEST(FarSides, WhereTheSensorLooksThroughThereIsNone) {
  const PointCloud cloud = cloud_of(cylinder_on_table()), empty_table = cloud_of(on_table({}));
  EXPECT_TRUE(find_far_sides(surfaces_of(cloud), DepthMap(empty_table)).cloud.empty());
}

TEST(FarSides, FingersStayClearOfAJarWiderThanItsLid) {
  // Behind the lid the jar goes on as wide as in front, but nothing of that is seen.
  for (const double radius : {0.028, 0.033, 0.037}) {
    SCOPED_TRACE(radius);
    AnalyticSolid lid = standing_cylinder(0, 0, radius - 0.006, 0.016);
    lid.T_scene_solid.translation().z() += 0.09;
    const AnalyticScene scene = on_table({standing_cylinder(0, 0, radius, 0.09), lid});
    const Gripper gripper;
    const Detection detection = detect_handles(render(scene).cloud, gripper, {});
    EXPECT_FALSE(detection.handles.empty());
    for (const Handle& handle : detection.handles)
      EXPECT_LT(judge(handle, gripper, {}, scene).finger_depth_m, 0.001);
  }
}

}  // namespace
}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/objects.hpp"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <set>
#include <span>

#include "tests/support/clouds.hpp"
#include "tests/support/scene_gallery.hpp"
#include "tests/unit/pipeline/voxel_surfaces.hpp"

namespace graspd {
namespace {

struct Grouped {
  VoxelSurfaces surfaces;
  std::optional<Support> support;
  Segments segments;
  Objects objects;
};

/// with_support: look for a table; else the largest plane might be taken for one.
Grouped group(const AnalyticScene& scene, bool with_support = true) {
  Grouped g;
  g.surfaces = voxel_surfaces(render(scene));
  const VoxelSurfaces& s = g.surfaces;
  if (with_support) g.support = find_support(s.cloud, {});
  const auto is_support = support_points(g.support);
  g.segments = build_segments(s.cloud, grow_regions(s.normals, s.neighborhoods, s.is_edge, is_support, {}),
                              kTestLeaf, {});
  g.objects = group_segments(s.cloud, s.normals, s.neighborhoods, g.segments, is_support, {});
  return g;
}

/// Objects that hold more than a twentieth of a solid's points that are in any.
std::set<std::int32_t> objects_of(const Grouped& g, int solid) {
  std::map<std::int32_t, int> count;
  int all = 0;
  for (std::size_t i = 0; i < g.surfaces.cloud.size(); ++i) {
    if (g.surfaces.solid[i] != solid || g.objects.of_point[i] < 0) continue;
    ++count[g.objects.of_point[i]];
    ++all;
  }
  std::set<std::int32_t> large;
  for (const auto& [object, n] : count)
    if (20 * n > all) large.insert(object);
  return large;
}

/// Each of the solids is one object of its own.
void expect_one_object_each(const Grouped& g, const std::vector<int>& solids) {
  std::set<std::int32_t> all;
  for (const int solid : solids) {
    const auto objects = objects_of(g, solid);
    EXPECT_EQ(objects.size(), 1u) << "solid " << solid;
    all.insert(objects.begin(), objects.end());
  }
  EXPECT_EQ(all.size(), solids.size());
}

AnalyticScene without_table(AnalyticScene scene) {
  scene.solids.erase(scene.solids.begin());
  return scene;
}

TEST(Objects, NothingToGroup) {
  const Objects objects = group_segments({}, {}, {}, {}, {}, {});
  EXPECT_EQ(objects.num_objects, 0);
}

TEST(Objects, ThreeFacesOfABoxAreOneObject) {
  // Turned, so that the camera sees the top and two sides.
  const Grouped g = group(without_table(on_table({standing_box(0, 0, {0.08, 0.09, 0.07}, 0.7)})), false);
  EXPECT_EQ(g.segments.list.size(), 3u);
  EXPECT_EQ(g.objects.num_objects, 1);
  expect_one_object_each(g, {0});
}

TEST(Objects, SideAndTopOfACylinderAreOneObject) {
  const Grouped g = group(without_table(cylinder_on_table()), false);
  EXPECT_GE(g.segments.list.size(), 2u);
  EXPECT_EQ(g.objects.num_objects, 1);
}

TEST(Objects, EveryBoxOnTheTableIsOne) {
  expect_one_object_each(group(box_on_table()), {1});
  expect_one_object_each(group(three_objects()), {1, 2, 3});
}

TEST(Objects, ABoxAgainstAWallIsNotTheWall) {
  const Grouped g = group(without_table(on_table({standing_box(0, 0, {0.10, 0.08, 0.08}),
                                                  standing_box(0, 0.14, {0.3, 0.2, 0.25})})),
                          false);
  expect_one_object_each(g, {0, 1});
}

TEST(Objects, TwoBoxesWithAConcaveBorderAreTwo) {
  // The lower one stands 20 mm farther back: flush fronts would be one surface to anybody.
  expect_one_object_each(group(on_table({standing_box(-0.025, 0, {0.05, 0.10, 0.10}),
                                         standing_box(0.025, 0.02, {0.05, 0.10, 0.06})})),
                         {1, 2});
  expect_one_object_each(group(bottle_beside_box()), {1, 2});
}

/// Objects of two level faces side by side, the second one lower by the step. Its normals lean away from the
/// first a little, as noise has it, so that the border is convex.
int objects_of_two_faces(float step_m) {
  constexpr float kSpacing = 0.003f;
  PointCloud cloud;
  cloud.viewpoint = {0, 0, 1};
  Normals normals;
  Labels labels;
  labels.num_labels = 2;
  for (int column = 0; column < 20; ++column)
    for (int row = 0; row < 20; ++row) {
      const bool is_second = column >= 10;
      cloud.push_back({kSpacing * static_cast<float>(column), kSpacing * static_cast<float>(row),
                       is_second ? -step_m : 0});
      const Eigen::Vector3f n = Eigen::Vector3f(is_second ? 0.05f : 0, 0, 1).normalized();
      normals.x.push_back(n.x());
      normals.y.push_back(n.y());
      normals.z.push_back(n.z());
      labels.of_point.push_back(is_second ? 1 : 0);
    }
  const Segments segments = build_segments(cloud, labels, kSpacing, {});
  return group_segments(cloud, normals, find_neighborhoods(cloud, {}, {}), segments, {}, {}).num_objects;
}

TEST(Objects, ParallelFacesWithAStepBetweenThemAreTwo) {
  EXPECT_EQ(objects_of_two_faces(0), 1);
  EXPECT_EQ(objects_of_two_faces(0.001f), 1) << "no more than noise";
  EXPECT_EQ(objects_of_two_faces(0.004f), 2);
  EXPECT_EQ(objects_of_two_faces(-0.004f), 2) << "whichever is the higher";
}

TEST(Objects, BoxesOfDifferentHeightWithFlushFrontsAreTwo) {
  expect_one_object_each(group(touching_boxes()), {1, 2});
}

TEST(Objects, ThePointsOfTheSupportBelongToNone) {
  const Grouped g = group(box_on_table());
  ASSERT_TRUE(g.support);
  for (std::size_t i = 0; i < g.surfaces.cloud.size(); ++i)
    if (g.support->is_support[i]) {
      EXPECT_EQ(g.objects.of_point[i], -1);
    }
}

TEST(Objects, TooShortABorderDoesNotJoin) {
  const VoxelSurfaces s = voxel_surfaces(render(without_table(box_on_table())));
  const Segments segments =
      build_segments(s.cloud, grow_regions(s.normals, s.neighborhoods, s.is_edge, {}, {}), kTestLeaf, {});
  ObjectsConfig config;
  config.min_border_pairs = 100000;
  const Objects apart = group_segments(s.cloud, s.normals, s.neighborhoods, segments, {}, config);
  EXPECT_EQ(apart.num_objects, static_cast<int>(segments.list.size()));
  for (std::size_t k = 0; k < segments.list.size(); ++k)
    EXPECT_EQ(apart.of_segment[k], static_cast<std::int32_t>(k));
}

TEST(Objects, PointsOfEachObjectAscendingAndNoOthers) {
  for (const int size : {0, 1, 7, 8, 9, 100}) {
    Objects objects;
    objects.num_objects = 4;  // number 2 has no points
    std::pmr::vector<std::pmr::vector<std::uint32_t>> expected(4);
    for (int i = 0; i < size; ++i) {
      const int object = i % 24 < 8 ? -1 : std::array{-1, 0, 3, 1, 1}[static_cast<std::size_t>(i % 5)];
      objects.of_point.push_back(object);
      if (object >= 0) expected[static_cast<std::size_t>(object)].push_back(static_cast<std::uint32_t>(i));
    }
    const ObjectPoints points = points_by_object(objects);
    for (std::size_t k = 0; k < 4; ++k) {
      const std::span<const std::uint32_t> of = points.of(k);
      EXPECT_EQ(std::pmr::vector<std::uint32_t>(of.begin(), of.end()), expected[k]) << size << " " << k;
    }
  }
}

TEST(Objects, ObjectsOfPointsAreThoseOfTheirSegments) {
  const Grouped g = group(three_objects());
  for (std::size_t i = 0; i < g.surfaces.cloud.size(); ++i) {
    const std::int32_t s = g.segments.of_point[i];
    if (s >= 0) {
      EXPECT_EQ(g.objects.of_point[i], g.objects.of_segment[static_cast<std::size_t>(s)]);
    }
  }
  const std::set<std::int32_t> numbers(g.objects.of_segment.begin(), g.objects.of_segment.end());
  EXPECT_EQ(numbers.size(), static_cast<std::size_t>(g.objects.num_objects));
  EXPECT_EQ(*numbers.begin(), 0);
  EXPECT_EQ(*numbers.rbegin(), g.objects.num_objects - 1);
}

}  // namespace
}  // namespace graspd

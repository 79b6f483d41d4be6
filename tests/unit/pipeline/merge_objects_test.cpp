// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The coarser guess at objects: what is one thing in spite of its borders, and what is not.
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <set>

#include "client/simulate/depth_camera.hpp"
#include "service/pipeline/objects.hpp"
#include "tests/support/clouds.hpp"
#include "tests/support/scene_gallery.hpp"
#include "tests/unit/pipeline/voxel_surfaces.hpp"

namespace graspd {
namespace {

struct Merged {
  VoxelSurfaces surfaces;
  Segments segments;
  Objects objects, wholes;
};

/// No support: the largest plane of a few objects alone might be taken for one.
Merged merged(const RenderedScene& scene, const ObjectsConfig& config = {}) {
  Merged m;
  m.surfaces = voxel_surfaces(scene);
  const VoxelSurfaces& s = m.surfaces;
  m.segments =
      build_segments(s.cloud, grow_regions(s.normals, s.neighborhoods, s.is_edge, {}, {}), kTestLeaf, {});
  m.objects = group_segments(s.cloud, s.normals, s.neighborhoods, m.segments, {}, config);
  m.wholes = merge_objects(s.cloud, s.normals, s.neighborhoods, m.objects, config);
  return m;
}

Merged merged(AnalyticScene scene) {
  scene.solids.erase(scene.solids.begin());
  return merged(render(scene));
}

/// 80 mm across and 100 mm high with a wall of 5 mm, upright on the origin, seen from the front and above.
RenderedScene mug() {
  Solid solid;
  solid.kind = "mug";
  solid.label = object_label(kFirstObject);
  solid.parts.emplace_back(Cylinder{0.04, 0, 0.1});
  solid.cavity = Cylinder{0.035, 0.005, 0.2};
  const Eigen::Isometry3d T_world_camera = look_at({0, -0.45, 0.45}, {0, 0, 0.05});
  const LabelledCloud seen = to_cloud(render({{solid}}, {640, 480, 525, 525, 319.5, 239.5}, T_world_camera));
  RenderedScene scene;
  scene.cloud = moved(seen.cloud, T_world_camera.cast<float>());
  for (std::size_t i = 0; i < scene.cloud.size(); ++i)
    scene.solid_of_point.push_back(scene.cloud.point(i).allFinite() ? 0 : -1);
  return scene;
}

/// The object of most of the points that lie somewhere.
std::int32_t object_at(const Merged& m, const Objects& objects,
                       const std::function<bool(const Eigen::Vector3f&)>& there) {
  std::map<std::int32_t, int> count;
  for (std::size_t i = 0; i < m.surfaces.cloud.size(); ++i)
    if (objects.of_point[i] >= 0 && there(m.surfaces.cloud.point(i))) ++count[objects.of_point[i]];
  std::int32_t most = -1;
  for (const auto& [object, n] : count)
    if (most < 0 || n > count[most]) most = object;
  return most;
}

bool outside(const Eigen::Vector3f& p) {
  return p.head<2>().norm() > 0.0385f && p.z() < 0.09f;
}

bool inside(const Eigen::Vector3f& p) {
  return p.head<2>().norm() < 0.0365f && p.z() < 0.09f;
}

std::int32_t object_of_solid(const Merged& m, int solid) {
  std::map<std::int32_t, int> count;
  for (std::size_t i = 0; i < m.surfaces.solid.size(); ++i)
    if (m.surfaces.solid[i] == solid) ++count[m.wholes.of_point[i]];
  std::int32_t most = -1;
  for (const auto& [object, n] : count)
    if (most < 0 || n > count[most]) most = object;
  return most;
}

/// wholes puts objects together and takes none apart, and numbers them without a gap.
void expect_consistent(const Merged& m) {
  std::map<std::int32_t, std::int32_t> whole_of{{-1, -1}};
  for (std::size_t s = 0; s < m.segments.list.size(); ++s) {
    const auto [it, first] = whole_of.emplace(m.objects.of_segment[s], m.wholes.of_segment[s]);
    EXPECT_EQ(it->second, m.wholes.of_segment[s]) << "segment " << s;
  }
  std::set<std::int32_t> numbers;
  std::vector<Eigen::Vector3d> sum(static_cast<std::size_t>(m.wholes.num_objects), Eigen::Vector3d::Zero());
  std::vector<int> count(sum.size());
  for (std::size_t i = 0; i < m.surfaces.cloud.size(); ++i) {
    const std::int32_t whole = m.wholes.of_point[i];
    ASSERT_EQ(whole, whole_of.at(m.objects.of_point[i])) << "point " << i;
    if (whole < 0) continue;
    ASSERT_LT(whole, m.wholes.num_objects);
    numbers.insert(whole);
    sum[static_cast<std::size_t>(whole)] += m.surfaces.cloud.point(i).cast<double>();
    ++count[static_cast<std::size_t>(whole)];
  }
  EXPECT_EQ(numbers.size(), static_cast<std::size_t>(m.wholes.num_objects));
  EXPECT_LE(m.wholes.num_objects, m.objects.num_objects);
  ASSERT_EQ(m.wholes.center.size(), sum.size());
  for (std::size_t k = 0; k < sum.size(); ++k)
    EXPECT_LT((m.wholes.center[k].cast<double>() - sum[k] / count[k]).norm(), 1e-4);
}

TEST(MergeObjects, NothingToMerge) {
  const Objects wholes = merge_objects({}, {}, {}, {}, {});
  EXPECT_EQ(wholes.num_objects, 0);
  EXPECT_TRUE(wholes.of_segment.empty());
  EXPECT_TRUE(wholes.center.empty());
}

TEST(MergeObjects, OneObjectStaysOne) {
  const Merged m = merged(box_on_table());
  EXPECT_EQ(m.objects.num_objects, 1);
  EXPECT_EQ(m.wholes.num_objects, 1);
  expect_consistent(m);
}

TEST(MergeObjects, OutsideAndInsideOfAMugBecomeOne) {
  const Merged m = merged(mug());
  EXPECT_GE(object_at(m, m.objects, outside), 0);
  EXPECT_NE(object_at(m, m.objects, outside), object_at(m, m.objects, inside))
      << "the finer guess has them apart, or this test shows nothing";
  EXPECT_EQ(object_at(m, m.wholes, outside), object_at(m, m.wholes, inside));
  expect_consistent(m);
}

TEST(MergeObjects, OnlyABorderThatIsLongEnoughCounts) {
  ObjectsConfig config;
  config.min_border_pairs = 100000;
  const Merged m = merged(mug(), config);
  EXPECT_GT(m.objects.num_objects, 1);
  EXPECT_EQ(m.wholes.num_objects, m.objects.num_objects);
  EXPECT_EQ(m.wholes.of_segment, m.objects.of_segment);
}

TEST(MergeObjects, BoxesSideBySideStayTwo) {
  const Merged apart = merged(
      on_table({standing_box(-0.035, 0, {0.05, 0.10, 0.08}), standing_box(0.035, 0, {0.05, 0.10, 0.08})}));
  EXPECT_NE(object_of_solid(apart, 0), object_of_solid(apart, 1));
  expect_consistent(apart);
  // They touch; the lower one stands 20 mm farther back.
  const Merged touching = merged(
      on_table({standing_box(-0.025, 0, {0.05, 0.10, 0.10}), standing_box(0.025, 0.02, {0.05, 0.10, 0.06})}));
  EXPECT_NE(object_of_solid(touching, 0), object_of_solid(touching, 1));
  expect_consistent(touching);
}

TEST(MergeObjects, ManyObjectsApartStayApart) {
  const Merged m = merged(spread_objects());
  std::set<std::int32_t> wholes;
  for (int solid = 0; solid < 9; ++solid) wholes.insert(object_of_solid(m, solid));
  EXPECT_EQ(wholes.size(), 9u);
  expect_consistent(m);
}

}  // namespace
}  // namespace graspd

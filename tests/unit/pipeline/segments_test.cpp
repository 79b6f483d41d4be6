// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/segments.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/clouds.hpp"
#include "tests/support/scene_gallery.hpp"
#include "tests/unit/pipeline/voxel_surfaces.hpp"

namespace graspd {
namespace {

Labels all_one(std::size_t n) {
  return {std::pmr::vector<std::int32_t>(n, 0), 1};
}

void expect_frame(const PointCloud& cloud, const Segment& segment) {
  EXPECT_NEAR(segment.normal.norm(), 1, 1e-5);
  EXPECT_NEAR(segment.major.norm(), 1, 1e-5);
  EXPECT_NEAR(segment.minor.norm(), 1, 1e-5);
  EXPECT_NEAR(segment.major.dot(segment.normal), 0, 1e-5);
  EXPECT_LT((segment.minor - segment.normal.cross(segment.major)).norm(), 1e-5);
  // a, f, n right-handed.
  EXPECT_NEAR(segment.major.cross(segment.minor).dot(segment.normal), 1, 1e-5);
  EXPECT_GE(segment.normal.dot(cloud.viewpoint - segment.centroid), 0);
}

TEST(Segments, NoLabels) {
  EXPECT_TRUE(build_segments({}, {}, kTestLeaf, {}).list.empty());
  const PointCloud cloud = random_cloud(10, {0, 0, 0}, {1, 1, 1}, 1);
  const Segments none = build_segments(cloud, {std::pmr::vector<std::int32_t>(10, -1), 0}, kTestLeaf, {});
  EXPECT_TRUE(none.list.empty());
  EXPECT_EQ(none.of_point, std::pmr::vector<std::int32_t>(10, -1));
}

TEST(Segments, AxesOfARectangle) {
  const Eigen::Vector3f n = Eigen::Vector3f(1, -2, 3).normalized(), u = n.unitOrthogonal(), v = n.cross(u);
  for (const float side : {1.0f, -1.0f}) {
    PointCloud cloud = grid_patch(0.5f * n, 0.003f * u, 0.003f * v, 40, 15);
    cloud.viewpoint = (0.5f + side) * n;
    const Segments segments = build_segments(cloud, all_one(cloud.size()), kTestLeaf, {});
    ASSERT_EQ(segments.list.size(), 1u);
    const Segment& segment = segments.list[0];
    expect_frame(cloud, segment);
    EXPECT_GT(segment.normal.dot(side * n), 0.9999f);
    EXPECT_GT(std::abs(segment.major.dot(u)), 0.9999f);
    EXPECT_GT(std::abs(segment.minor.dot(v)), 0.9999f);
    EXPECT_LT(segment.scatter_m, 1e-6f);
    EXPECT_LT((segment.centroid - (0.5f * n + 0.003f * (19.5f * u + 7.0f * v))).norm(), 1e-5);
  }
}

TEST(Segments, ScatterAboutThePlane) {
  PointCloud cloud = grid_patch({0, 0, 1}, {0.003f, 0, 0}, {0, 0.003f, 0}, 20, 20);
  for (std::size_t i = 0; i < cloud.size(); ++i) cloud.z[i] += i % 2 == i / 20 % 2 ? 0.002f : -0.002f;
  const Segments segments = build_segments(cloud, all_one(cloud.size()), kTestLeaf, {});
  ASSERT_EQ(segments.list.size(), 1u);
  EXPECT_NEAR(segments.list[0].scatter_m, 0.002f, 2e-5f);
}

TEST(Segments, SmallSurfacesAreLeftOut) {
  const PointCloud cloud = joined(grid_patch({0, 0, 1}, {0.003f, 0, 0}, {0, 0.003f, 0}, 20, 2),
                                  grid_patch({1, 0, 1}, {0.003f, 0, 0}, {0, 0.003f, 0}, 13, 3));
  Labels labels{std::pmr::vector<std::int32_t>(cloud.size(), 1), 2};
  std::fill_n(labels.of_point.begin(), 40, 0);
  SegmentsConfig config;
  config.min_area_m2 = 40 * kTestLeaf * kTestLeaf * 0.999f;
  const Segments segments = build_segments(cloud, labels, kTestLeaf, config);
  ASSERT_EQ(segments.list.size(), 1u);
  EXPECT_EQ(segments.list[0].points.size(), 40u);
  for (std::size_t i = 0; i < cloud.size(); ++i) EXPECT_EQ(segments.of_point[i], i < 40 ? 0 : -1);
}

TEST(Segments, ListsAndIndicesAgreeOnAScene) {
  const VoxelSurfaces s = voxel_surfaces(render(three_objects()));
  const Labels labels = grow_regions(s.normals, s.neighborhoods, s.is_edge, {}, {});
  const Segments segments = build_segments(s.cloud, labels, kTestLeaf, {});
  EXPECT_GE(segments.list.size(), 4u);
  std::size_t listed = 0;
  for (std::size_t k = 0; k < segments.list.size(); ++k) {
    const Segment& segment = segments.list[k];
    expect_frame(s.cloud, segment);
    EXPECT_TRUE(std::is_sorted(segment.points.begin(), segment.points.end()));
    EXPECT_GE(segment.points.size(), 40u);
    for (const std::uint32_t i : segment.points) {
      EXPECT_EQ(segments.of_point[i], static_cast<std::int32_t>(k));
      EXPECT_EQ(labels.of_point[i], labels.of_point[segment.points[0]]);
    }
    listed += segment.points.size();
  }
  const auto in_one =
      std::count_if(segments.of_point.begin(), segments.of_point.end(), [](int k) { return k >= 0; });
  EXPECT_EQ(listed, static_cast<std::size_t>(in_one));
}

TEST(Segments, DegenerateSurfacesHaveAFrameToo) {
  SegmentsConfig config;
  config.min_area_m2 = 0;
  PointCloud line = grid_patch({0.1f, 0.1f, 1}, {0.003f, 0, 0}, {0, 0, 0}, 50, 1);
  PointCloud point = random_cloud(50, {0.1f, 0.1f, 1}, {0.1f, 0.1f, 1}, 1);
  for (const PointCloud& cloud : {line, point}) {
    const Segments segments = build_segments(cloud, all_one(cloud.size()), kTestLeaf, config);
    ASSERT_EQ(segments.list.size(), 1u);
    expect_frame(cloud, segments.list[0]);
  }
}

}  // namespace
}  // namespace graspd

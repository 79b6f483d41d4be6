// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/surfaces.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "service/pipeline/workspace_filter.hpp"
#include "tests/support/clouds.hpp"
#include "tests/support/scene_gallery.hpp"

namespace graspd {
namespace {

Surfaces surfaces_of(const PointCloud& cloud, const DetectConfig& config = {}) {
  return find_surfaces(filter_workspace(cloud, config.workspace).cloud, config, [](std::string_view) {});
}

TEST(Surfaces, OneElementAVoxel) {
  const PointCloud cloud = finite_points(render(three_objects()).cloud);
  const Surfaces s = surfaces_of(cloud);
  const std::size_t n = s.cloud.size();
  EXPECT_EQ(s.voxel_of_point.size(), cloud.size());
  for (const std::uint32_t voxel : s.voxel_of_point) ASSERT_LT(voxel, n);
  EXPECT_EQ(s.normals.size(), n);
  EXPECT_EQ(s.is_edge.size(), n);
  EXPECT_EQ(s.segments.of_point.size(), n);
  EXPECT_EQ(s.objects.of_point.size(), n);
  EXPECT_EQ(s.objects.of_segment.size(), s.segments.list.size());
  ASSERT_TRUE(s.support);
  EXPECT_EQ(s.support->is_support.size(), n);
}

TEST(Surfaces, ThreeObjectsAndNoPointOfTheTableInThem) {
  const Surfaces s = surfaces_of(render(three_objects()).cloud);
  EXPECT_EQ(s.objects.num_objects, 3);
  for (std::size_t i = 0; i < s.cloud.size(); ++i)
    if (s.support->is_support[i]) {
      EXPECT_EQ(s.segments.of_point[i], -1);
      EXPECT_EQ(s.objects.of_point[i], -1);
    }
}

/// Those found in a box around everything, ascending.
std::pmr::vector<std::uint32_t> all_of(const BoxQuery& query) {
  LocalPoints found;
  query.find({0, 0, 0}, Eigen::Matrix3f::Identity(), {-9, -9, -9}, {9, 9, 9}, found);
  std::pmr::vector<std::uint32_t> indices(found.index.begin(), found.index.end());
  std::sort(indices.begin(), indices.end());
  return indices;
}

TEST(Surfaces, BoxesHoldAllPointsButTheSupports) {
  for (const bool has_support : {true, false}) {
    DetectConfig config;
    config.support.enabled = has_support;
    const Surfaces s = surfaces_of(render(three_objects()).cloud, config);
    ASSERT_EQ(s.support.has_value(), has_support);
    std::pmr::vector<std::uint32_t> others;
    for (std::uint32_t i = 0; i < s.voxel_of_point.size(); ++i)
      if (!has_support || s.support->is_support[s.voxel_of_point[i]] == 0) others.push_back(i);
    EXPECT_EQ(all_of(s.points), others);
    EXPECT_EQ(all_of(s.sparse.query).size(), s.sparse.voxel.size());
    for (const std::uint32_t voxel : s.sparse.voxel)
      EXPECT_TRUE(!has_support || s.support->is_support[voxel] == 0);
  }
}

TEST(Surfaces, WithoutASupportTheTableIsASegment) {
  DetectConfig config;
  config.support.enabled = false;
  const PointCloud cloud = render(three_objects()).cloud;
  const Surfaces with = surfaces_of(cloud), without = surfaces_of(cloud, config);
  EXPECT_FALSE(without.support);
  std::size_t largest = 0;
  for (const Segment& segment : without.segments.list) largest = std::max(largest, segment.points.size());
  EXPECT_GT(largest, without.cloud.size() / 2);
  EXPECT_GT(without.segments.list.size(), with.segments.list.size());
}

TEST(Surfaces, SmoothingRunsAsOftenAsAskedAndFlattens) {
  const PointCloud noisy = with_range_noise(render(box_on_table()).cloud, 0.001f, 1);
  DetectConfig config;
  const Surfaces rough = surfaces_of(noisy, config);
  config.smoothing.iterations = 2;
  const Surfaces smooth = surfaces_of(noisy, config);
  // The front of the box is the plane y = -0.06.
  const auto scatter = [](const Surfaces& s) {
    double sum = 0;
    int n = 0;
    for (std::size_t i = 0; i < s.cloud.size(); ++i) {
      const Eigen::Vector3f p = s.cloud.point(i);
      if (std::abs(p.x()) > 0.015f || p.z() < 0.02f || p.z() > 0.06f || std::abs(p.y() + 0.06f) > 0.01f)
        continue;
      sum += (p.y() + 0.06) * (p.y() + 0.06);
      ++n;
    }
    return std::sqrt(sum / n);
  };
  EXPECT_LT(scatter(smooth), 0.6 * scatter(rough));
  // By itself where the table scatters.
  config = {};
  config.smoothing.from_scatter_m = 0.0001f;
  EXPECT_LT(scatter(surfaces_of(noisy, config)), 0.6 * scatter(rough));
}

}  // namespace
}  // namespace graspd

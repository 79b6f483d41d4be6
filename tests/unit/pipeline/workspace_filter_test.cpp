// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/workspace_filter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>

#include "tests/support/clouds.hpp"

namespace graspd {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();

PointCloud cloud_of(std::initializer_list<Eigen::Vector3f> points) {
  PointCloud cloud;
  for (const Eigen::Vector3f& p : points) cloud.push_back(p);
  cloud.width = static_cast<int>(cloud.size());
  return cloud;
}

WorkspaceFilterConfig box(const Eigen::Vector3f& min, const Eigen::Vector3f& max) {
  WorkspaceFilterConfig config;
  config.min_m = min;
  config.max_m = max;
  config.min_range_m = 0;
  config.max_range_m = 100;
  return config;
}

TEST(WorkspaceFilter, EmptyCloud) {
  const WorkspaceResult result = filter_workspace({}, {});
  EXPECT_TRUE(result.cloud.empty());
  EXPECT_EQ(result.num_finite, 0u);
}

TEST(WorkspaceFilter, DropsWhatIsNotFinite) {
  PointCloud cloud;
  for (const float bad : {kNan, kInf, -kInf})
    for (int axis = 0; axis < 3; ++axis) {
      Eigen::Vector3f p(0.1f, 0.2f, 0.5f);
      cloud.push_back(p);
      p[axis] = bad;
      cloud.push_back(p);
    }
  const WorkspaceResult result = filter_workspace(cloud, {});
  EXPECT_EQ(result.num_finite, 9u);
  ASSERT_EQ(result.cloud.size(), 9u);
  EXPECT_EQ(result.cloud.width, 9);
  EXPECT_EQ(result.cloud.height, 1);
  for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(result.cloud.point(i), Eigen::Vector3f(0.1f, 0.2f, 0.5f));
}

TEST(WorkspaceFilter, LimitsBelongToTheWorkspace) {
  const PointCloud cloud = cloud_of(
      {{1, 1, 1}, {-1, -1, -1}, {0, 0, 0.5f}, {1.001f, 0, 0.5f}, {0, -1.001f, 0.5f}, {0, 0, 1.001f}});
  const WorkspaceResult result = filter_workspace(cloud, box({-1, -1, -1}, {1, 1, 1}));
  ASSERT_EQ(result.cloud.size(), 3u);
  EXPECT_EQ(result.num_finite, 6u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(result.cloud.point(i), cloud.point(i)) << "the order stays";
}

TEST(WorkspaceFilter, RangeIsFromTheViewpoint) {
  PointCloud cloud = cloud_of({{2, 0, 0}, {2.5f, 0, 0}, {3, 0, 0}, {3.5f, 0, 0}, {4, 0, 0}});
  cloud.viewpoint = {2, 0, 0};
  WorkspaceFilterConfig config;
  config.min_range_m = 0.5f;
  config.max_range_m = 1.5f;
  const WorkspaceResult result = filter_workspace(cloud, config);
  ASSERT_EQ(result.cloud.size(), 3u);
  EXPECT_EQ(result.cloud.x[0], 2.5f);
  EXPECT_EQ(result.cloud.x[2], 3.5f);
  EXPECT_EQ(result.cloud.viewpoint, cloud.viewpoint);
}

TEST(WorkspaceFilter, TheBoxIsInItsOwnFrame) {
  WorkspaceFilterConfig config = box({0.9f, -0.1f, -0.1f}, {1.1f, 0.1f, 0.1f});
  // The cloud's y axis is the box's x axis.
  config.T_box_cloud.linear() =
      Eigen::AngleAxisf(-std::numbers::pi_v<float> / 2, Eigen::Vector3f::UnitZ()).toRotationMatrix();
  config.T_box_cloud.translation() = Eigen::Vector3f(0.5f, 0, 0);
  const PointCloud cloud = cloud_of({{0, 0.5f, 0}, {0.5f, 0, 0}, {1, 0, 0}});
  const WorkspaceResult result = filter_workspace(cloud, config);
  ASSERT_EQ(result.cloud.size(), 1u);
  EXPECT_EQ(result.cloud.point(0), cloud.point(0)) << "points stay in the cloud's frame";
}

TEST(WorkspaceFilter, HugeCoordinatesAreOutside) {
  const float huge = std::numeric_limits<float>::max();
  const WorkspaceResult result = filter_workspace(
      cloud_of({{1e30f, 0, 0}, {0, -1e30f, 0}, {huge, huge, huge}, {-huge, 0, huge}, {0.1f, 0.1f, 0.5f}}),
      {});
  EXPECT_EQ(result.num_finite, 5u);
  EXPECT_EQ(result.cloud.size(), 1u);
}

TEST(WorkspaceFilter, AnUnknownViewpointLeavesNothing) {
  PointCloud cloud = cloud_of({{0.1f, 0.1f, 0.5f}});
  cloud.viewpoint = {kNan, 0, 0};
  EXPECT_TRUE(filter_workspace(cloud, {}).cloud.empty());
}

TEST(WorkspaceFilterConfig, EmptyWorkspacesAreRefused) {
  WorkspaceFilterConfig config;
  EXPECT_FALSE(config.validate());
  for (int axis = 0; axis < 3; ++axis) {
    config = {};
    config.max_m[axis] = config.min_m[axis];
    ASSERT_TRUE(config.validate());
    EXPECT_EQ(config.validate()->key, "max_m");
  }
  config = {};
  config.min_range_m = config.max_range_m;
  ASSERT_TRUE(config.validate());
  EXPECT_EQ(config.validate()->key, "max_range_m");
  config = {};
  config.min_m.x() = kNan;
  EXPECT_TRUE(config.validate());
}

TEST(WorkspaceFilter, TellsWhichPixelsOfAnImageTheKeptPointsAre) {
  PointCloud cloud = random_cloud(std::size_t{300} * 230, {-1, -1, 0.2f}, {1, 1, 1}, 3);  // several chunks
  cloud.width = 300;
  cloud.height = 230;
  for (std::size_t i = 0; i < cloud.size(); i += 7) cloud.y[i] = kNan;
  const WorkspaceResult result = filter_workspace(cloud, box({-0.5f, -1, 0}, {1, 1, 1}));
  EXPECT_EQ(result.pixels.width, 300);
  EXPECT_EQ(result.pixels.height, 230);
  ASSERT_EQ(result.pixels.of_point.size(), result.cloud.size());
  EXPECT_TRUE(std::is_sorted(result.pixels.of_point.begin(), result.pixels.of_point.end()));
  for (std::size_t i = 0; i < result.cloud.size(); ++i)
    ASSERT_EQ(result.cloud.point(i), cloud.point(result.pixels.of_point[i]));
  cloud.width = 300 * 230;
  cloud.height = 1;
  EXPECT_TRUE(filter_workspace(cloud, {}).pixels.of_point.empty());
}

}  // namespace
}  // namespace graspd

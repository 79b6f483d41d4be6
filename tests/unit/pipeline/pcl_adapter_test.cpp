// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/pcl_adapter.hpp"

#include <gtest/gtest.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "tests/support/clouds.hpp"

namespace graspd {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

void expect_same_bits(float a, float b) {
  EXPECT_EQ(std::bit_cast<std::uint32_t>(a), std::bit_cast<std::uint32_t>(b));
}

/// 3 x 2 points whose coordinates tell their place; one is missing.
template <typename PointT>
pcl::PointCloud<PointT> organized() {
  pcl::PointCloud<PointT> cloud(3, 2);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    cloud[i].x = static_cast<float>(i);
    cloud[i].y = static_cast<float>(i) + 0.25f;
    cloud[i].z = static_cast<float>(i) + 0.5f;
  }
  cloud[4].x = cloud[4].y = cloud[4].z = kNaN;
  cloud.is_dense = false;
  cloud.sensor_origin_ << 0.1f, -0.2f, 0.3f, 0;
  return cloud;
}

template <typename PointT>
class PclAdapter : public testing::Test {};
using PointTypes =
    testing::Types<pcl::PointXYZ, pcl::PointXYZI, pcl::PointXYZL, pcl::PointXYZRGB, pcl::PointXYZRGBA,
                   pcl::PointNormal, pcl::PointXYZINormal, pcl::PointXYZRGBNormal>;
TYPED_TEST_SUITE(PclAdapter, PointTypes);

TYPED_TEST(PclAdapter, EmptyStaysEmpty) {
  const PointCloud cloud = from_pcl(pcl::PointCloud<TypeParam>());
  EXPECT_TRUE(cloud.empty());
  EXPECT_EQ(cloud.width * cloud.height, 0);
}

TYPED_TEST(PclAdapter, OrganizedStaysOrganizedWithItsMissingPoints) {
  const PointCloud cloud = from_pcl(organized<TypeParam>());
  ASSERT_EQ(cloud.size(), 6u);
  EXPECT_EQ(cloud.width, 3);
  EXPECT_EQ(cloud.height, 2);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (i == 4) continue;
    EXPECT_EQ(cloud.point(i), Eigen::Vector3f(static_cast<float>(i), static_cast<float>(i) + 0.25f,
                                              static_cast<float>(i) + 0.5f));
  }
  EXPECT_TRUE(cloud.point(4).array().isNaN().all());
}

TYPED_TEST(PclAdapter, SensorOriginIsTheViewpoint) {
  EXPECT_EQ(from_pcl(organized<TypeParam>()).viewpoint, Eigen::Vector3f(0.1f, -0.2f, 0.3f));
}

TEST(PclAdapterShape, PointsBeyondTheShapeMakeItUnorganized) {
  auto cloud = organized<pcl::PointXYZ>();
  cloud.points.emplace_back(9.0f, 9.0f, 9.0f);  // past PCL's own push_back, which resets the shape
  const PointCloud result = from_pcl(cloud);
  EXPECT_EQ(result.size(), 7u);
  EXPECT_EQ(result.width, 7);
  EXPECT_EQ(result.height, 1);
}

TEST(PclAdapterShape, ShapeThatPointsLackMakesItUnorganized) {
  PointCloud cloud = random_cloud(5, {0, 0, 0}, {1, 1, 1}, 1);
  cloud.width = 640;
  cloud.height = 480;
  const auto result = to_pcl(cloud);
  EXPECT_EQ(result.size(), 5u);
  EXPECT_EQ(result.width, 5u);
  EXPECT_EQ(result.height, 1u);
}

TEST(PclAdapterRoundTrip, KeepsEveryBit) {
  PointCloud cloud = random_cloud(12, {-1, -1, 0.5f}, {1, 1, 2}, 2);
  cloud.width = 4;
  cloud.height = 3;
  cloud.viewpoint = {0.5f, 0.25f, -1};
  cloud.x[7] = cloud.y[7] = cloud.z[7] = kNaN;
  cloud.z[8] = std::numeric_limits<float>::infinity();
  const PointCloud back = from_pcl(to_pcl(cloud));
  ASSERT_EQ(back.size(), cloud.size());
  EXPECT_EQ(back.width, 4);
  EXPECT_EQ(back.height, 3);
  EXPECT_EQ(back.viewpoint, cloud.viewpoint);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    expect_same_bits(back.x[i], cloud.x[i]);
    expect_same_bits(back.y[i], cloud.y[i]);
    expect_same_bits(back.z[i], cloud.z[i]);
  }
}

TEST(PclAdapterRoundTrip, DenseOnlyWhenEveryPointIsFinite) {
  PointCloud cloud = random_cloud(8, {0, 0, 0}, {1, 1, 1}, 3);
  EXPECT_TRUE(to_pcl(cloud).is_dense);
  cloud.y[5] = kNaN;
  EXPECT_FALSE(to_pcl(cloud).is_dense);
}

}  // namespace
}  // namespace graspd

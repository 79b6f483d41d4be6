// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/common/cloud_colors.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "service/transport/cloud_encoder.hpp"

namespace graspd {
namespace {

using Colors = std::vector<std::uint32_t>;

PointCloud three_points() {
  PointCloud cloud;
  for (const float x : {1.f, 2.f, 3.f}) cloud.push_back({x, 0, 1});
  cloud.width = 3;
  return cloud;
}

const Colors kColors{0x112233, 0xff0000, 0x0000ff};

TEST(CloudColors, AreThoseOfTheMessage) {
  EXPECT_EQ(cloud_colors(encode(make_point_cloud({0, 0, "camera"}, three_points(), kColors)), {}), kColors);
  const Colors labels{1, 2, 3};
  EXPECT_EQ(cloud_colors(encode(make_point_cloud({0, 0, ""}, three_points(), kColors, labels)), {}), kColors);
}

TEST(CloudColors, AreNoneWhereThereAreNone) {
  EXPECT_EQ(cloud_colors(encode(make_point_cloud({}, three_points())), {}), Colors{});
  const DepthCamera camera{2, 1, 1, 1, 0, 0, 0.001};
  const std::vector<std::uint16_t> depth{1, 2};
  EXPECT_EQ(cloud_colors(encode(make_depth_image({}, camera, depth)), {}), Colors{});
  EXPECT_EQ(cloud_colors({}, {}), Colors{});
}

TEST(CloudColors, TrustNothing) {
  const std::vector<std::byte> good = encode(make_point_cloud({1, 2, "camera"}, three_points(), kColors));
  for (std::size_t size = 0; size < good.size(); ++size)
    EXPECT_EQ(cloud_colors(std::span(good).first(size), {}), Colors{}) << size;
  std::mt19937 random(1);
  for (int i = 0; i < 50'000; ++i) {
    std::vector<std::byte> bytes = good;
    for (int k = 0; k < 4; ++k) bytes[8 + random() % (bytes.size() - 8)] = static_cast<std::byte>(random());
    const Colors colors = cloud_colors(bytes, {});
    EXPECT_LE(colors.size() * 4, bytes.size());
  }
  DecodeLimits small;
  small.max_points = 2;
  EXPECT_EQ(cloud_colors(good, small), Colors{});
}

}  // namespace
}  // namespace graspd

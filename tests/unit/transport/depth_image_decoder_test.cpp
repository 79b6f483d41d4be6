// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/depth_image_decoder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "service/transport/cloud_encoder.hpp"
#include "tests/unit/transport/cloud_expectations.hpp"

namespace graspd {
namespace {

constexpr std::int32_t kMin32 = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kMax32 = std::numeric_limits<std::int32_t>::max();

/// The pinhole model word for word, in double, from the generated decoder's message.
void expect_same(const Frame& frame, const depth_image_t& oracle) {
  EXPECT_EQ(frame.utime, oracle.utime);
  EXPECT_EQ(frame.seq, oracle.seq);
  EXPECT_EQ(std::string_view(frame.frame_name), oracle.frame_name);
  ASSERT_EQ(frame.cloud.width, oracle.width);
  ASSERT_EQ(frame.cloud.height, oracle.height);
  ASSERT_EQ(frame.cloud.size(), oracle.data.size() / 2);
  EXPECT_EQ(frame.cloud.viewpoint, Eigen::Vector3f::Zero());
  for (int v = 0; v < oracle.height; ++v) {
    for (int u = 0; u < oracle.width; ++u) {
      const auto i = static_cast<std::size_t>(v * oracle.width + u);
      const int depth = oracle.data[2 * i] + 256 * oracle.data[2 * i + 1];
      const Eigen::Vector3f point = frame.cloud.point(i);
      if (depth == 0) {
        ASSERT_TRUE(point.array().isNaN().all());
        continue;
      }
      const double z = depth * oracle.depth_scale;
      const Eigen::Vector3d expected((u - oracle.cx) / oracle.fx * z, (v - oracle.cy) / oracle.fy * z, z);
      ASSERT_LE((point.cast<double>() - expected).norm(), 4e-7 * expected.norm());
    }
  }
}

TEST(DepthImageDecoder, EqualsThePinholeModelOnValidMessages) {
  Random random(43);
  for (int i = 0; i < 500; ++i) {
    const Bytes message = raw_bytes(random_depth_image(random, i % 40));
    expect_same(decoded(message), generated_decode<depth_image_t>(message));
    if (HasFatalFailure()) FAIL() << "message " << i;
  }
}

TEST(DepthImageDecoder, PrincipalPointLooksStraightAhead) {
  const DepthCamera camera{3, 3, 500, 400, 1, 1, 0.001};
  const std::vector<std::uint16_t> depth{0, 0, 0, 0, 1000, 2000, 0, 65535, 0};
  const PointCloud cloud = decoded(encode(make_depth_image({1, 2, "f"}, camera, depth))).cloud;
  EXPECT_EQ(cloud.point(4), Eigen::Vector3f(0, 0, 1));
  EXPECT_TRUE(cloud.point(5).isApprox(Eigen::Vector3f(2.0f / 500, 0, 2)));
  EXPECT_TRUE(cloud.point(7).isApprox(Eigen::Vector3f(0, 65.535f / 400, 65.535f)));
  EXPECT_TRUE(std::isnan(cloud.z[0]));
}

TEST(DepthImageDecoder, NoPixelsAreAFrame) {
  for (const auto& [width, height] : {std::pair{0, 0}, std::pair{640, 0}, std::pair{0, kMax32}}) {
    depth_image_t image{};  // without intrinsics: a camera that is not ready yet
    image.width = width;
    image.height = height;
    EXPECT_TRUE(decoded(raw_bytes(image)).cloud.empty());
  }
}

TEST(DepthImageDecoder, RefusesLyingSizes) {
  const auto refuses = [](auto spoil, RefusalReason reason, const std::string& text) {
    depth_image_t image = small_depth_image();
    spoil(image);
    expect_refusal(raw_bytes(image), reason, text);
  };
  using enum RefusalReason;
  refuses([](auto& m) { m.width = 3; }, kBadSize,
          "depth_image_t.data_size: contradicts the other sizes (got 4");
  refuses([](auto& m) { m.height = 0; }, kBadSize, "expected 2 * 0 * 2");
  refuses([](auto& m) { m.width = -2; }, kBadSize, "negative");
  refuses([](auto& m) { m.width = m.height = kMin32; }, kBadSize, "negative");
  refuses([](auto& m) { m.width = m.height = kMax32; }, kTooLarge, "too many points");
  refuses([](auto& m) { m.width = m.height = 1 << 16; }, kTooLarge, "too many points");
  const Bytes message = raw_bytes(small_depth_image());
  for (const std::int32_t size : {kMin32, -1, 0, 3, 5, kMax32}) {
    Bytes lying = message;
    put(lying, message.size() - 8, size, 4);
    expect_refusal(lying, kBadSize, "data_size");
  }
}

TEST(DepthImageDecoder, RefusesIntrinsicsOfNoCamera) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const auto refuses = [](double depth_image_t::*member, double value, const std::string& text) {
    depth_image_t image = small_depth_image();
    image.*member = value;
    expect_refusal(raw_bytes(image), RefusalReason::kBadCalibration, text);
  };
  for (const double value : {nan, infinity, -infinity, 0.0, -1.0, 1e300, 1e-300}) {
    refuses(&depth_image_t::depth_scale, value, "depth_image_t.depth_scale: no camera's (got ");
    refuses(&depth_image_t::fx, value, "depth_image_t.fx");
    refuses(&depth_image_t::fy, value, "depth_image_t.fy");
  }
  for (const double value : {nan, infinity, -infinity, 1e300}) {
    refuses(&depth_image_t::cx, value, "depth_image_t.cx");
    refuses(&depth_image_t::cy, value, "depth_image_t.cy");
  }
}

TEST(DepthImageDecoder, AcceptedIntrinsicsGiveFinitePoints) {
  for (const double scale : {1e-9, 1.0}) {
    for (const double f : {1e-3, 1e7}) {
      for (const double c : {-1e7, 1e7}) {
        const DepthCamera camera{2, 1, f, f, c, c, scale};
        const std::vector<std::uint16_t> depth{1, 65535};
        const PointCloud cloud = decoded(encode(make_depth_image({}, camera, depth))).cloud;
        EXPECT_TRUE(cloud.point(0).allFinite() && cloud.point(1).allFinite());
      }
    }
  }
}

}  // namespace
}  // namespace graspd

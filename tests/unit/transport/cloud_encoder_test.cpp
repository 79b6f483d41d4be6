// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/cloud_encoder.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <stdexcept>

#include "tests/unit/transport/cloud_expectations.hpp"

namespace graspd {
namespace {

PointCloud two_by_three() {
  PointCloud cloud;
  for (int i = 0; i < 6; ++i) cloud.push_back(Eigen::Vector3f(0.1f, 0.2f, 0.3f) * static_cast<float>(i));
  cloud.width = 2;
  cloud.height = 3;
  cloud.viewpoint = {1, 2, 3};
  return cloud;
}

TEST(CloudEncoder, CloudSurvivesTheWire) {
  const PointCloud cloud = two_by_three();
  const std::vector<std::uint32_t> extra(6, 0xffffffff);
  for (const bool with_rgb : {false, true}) {
    for (const bool with_label : {false, true}) {
      const auto message =
          make_point_cloud({11, 12, "camera"}, cloud, with_rgb ? extra : std::vector<std::uint32_t>{},
                           with_label ? extra : std::vector<std::uint32_t>{});
      EXPECT_EQ(message.point_step, 12 + 4 * with_rgb + 4 * with_label);
      const Frame frame = decoded(encode(message));
      EXPECT_EQ(frame.utime, 11);
      EXPECT_EQ(frame.seq, 12);
      EXPECT_EQ(frame.frame_name, "camera");
      EXPECT_EQ(frame.cloud.x, cloud.x);
      EXPECT_EQ(frame.cloud.y, cloud.y);
      EXPECT_EQ(frame.cloud.z, cloud.z);
      EXPECT_EQ(frame.cloud.width, 2);
      EXPECT_EQ(frame.cloud.height, 3);
      EXPECT_EQ(frame.cloud.viewpoint, cloud.viewpoint);
    }
  }
}

TEST(CloudEncoder, ColoursAndLabelsLieWhereTheirFieldsSay) {
  const std::vector<std::uint32_t> rgb{1, 2, 3, 4, 5, 6};
  const std::vector<std::uint32_t> label{10, 20, 30, 40, 50, 60};
  const auto message = make_point_cloud({}, two_by_three(), rgb, label);
  ASSERT_EQ(message.num_fields, 5);
  for (const auto& [index, name, values] : {std::tuple(3u, "rgb", rgb), std::tuple(4u, "label", label)}) {
    const point_field_t& field = message.fields[index];
    EXPECT_EQ(field.name, name);
    EXPECT_EQ(field.datatype, +point_field_t::UINT32);
    for (std::size_t i = 0; i < values.size(); ++i) {
      std::uint32_t value = 0;
      std::memcpy(&value, &message.data[i * 20 + static_cast<std::size_t>(field.offset)], sizeof(value));
      EXPECT_EQ(value, values[i]);
    }
  }
}

TEST(CloudEncoder, NothingIsACloudToo) {
  EXPECT_TRUE(decoded(encode(make_point_cloud({}, {}))).cloud.empty());
  EXPECT_TRUE(decoded(encode(make_depth_image({}, {}, {}))).cloud.empty());
}

TEST(CloudEncoder, LengthsThatDifferThrow) {
  const std::vector<std::uint32_t> five(5);
  EXPECT_THROW((void)make_point_cloud({}, two_by_three(), five), std::invalid_argument);
  EXPECT_THROW((void)make_point_cloud({}, two_by_three(), {}, five), std::invalid_argument);
  PointCloud wrong = two_by_three();
  wrong.height = 4;
  EXPECT_THROW((void)make_point_cloud({}, wrong), std::invalid_argument);
  EXPECT_THROW((void)make_depth_image({}, {2, 2}, std::vector<std::uint16_t>(3)), std::invalid_argument);
}

TEST(CloudEncoder, CountsThatLieThrow) {
  point_cloud_t cloud = small_point_cloud();
  cloud.num_fields = 4;
  EXPECT_THROW((void)encode(cloud), std::invalid_argument);
  cloud = small_point_cloud();
  cloud.data_size = -1;
  EXPECT_THROW((void)encode(cloud), std::invalid_argument);
  depth_image_t image = small_depth_image();
  image.data_size = 6;
  EXPECT_THROW((void)encode(image), std::invalid_argument);
}

TEST(CloudEncoder, BuffersAreReused) {
  std::vector<std::byte> buffer;
  encode(make_point_cloud({1, 2, "f"}, two_by_three()), buffer);
  const std::byte* memory = buffer.data();
  encode(small_depth_image(), buffer);
  EXPECT_EQ(buffer.data(), memory);
  EXPECT_EQ(buffer, encode(small_depth_image()));
}

TEST(CloudEncoder, NamesEndAtANulInside) {
  const FrameHeader header{1, 2, std::pmr::string("ab\0cd", 5)};
  EXPECT_EQ(decoded(encode(make_point_cloud(header, {}))).frame_name, "ab");
}

}  // namespace
}  // namespace graspd

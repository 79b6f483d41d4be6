// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/view/frame_message.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "service/transport/cloud_encoder.hpp"

namespace graspd {
namespace {

/// What the page does, in C++.
struct Read {
  explicit Read(const std::string& message) : text(message) {
    EXPECT_EQ(text.substr(0, 4), "GVF1");
    points = get<std::uint32_t>(8);
    colors = get<std::uint32_t>(16) & 1;
    json = nlohmann::json::parse(text.substr(60, get<std::uint32_t>(4)));
    data = 60 + (get<std::uint32_t>(4) + 3) / 4 * 4;
  }
  template <class T>
  [[nodiscard]] T get(std::size_t at) const {
    T value{};
    std::memcpy(&value, text.data() + at, sizeof value);
    return value;
  }
  [[nodiscard]] Eigen::Vector3f point(std::size_t i) const {
    Eigen::Vector3f p;
    for (std::size_t k = 0; k < 3; ++k)
      p[static_cast<Eigen::Index>(k)] =
          get<float>(28 + 4 * k) +
          get<float>(40) * static_cast<float>(get<std::uint16_t>(data + 6 * i + 2 * k));
    return p;
  }

  const std::string& text;
  std::size_t points = 0, data = 0;
  bool colors = false;
  nlohmann::json json;
};

MatchedFrame frame_of(const PointCloud& cloud, const std::vector<std::uint32_t>& rgb = {}) {
  MatchedFrame frame;
  frame.channel = "CLOUDS";
  frame.header = {123, 7, "camera"};
  frame.cloud = encode(make_point_cloud(frame.header, cloud, rgb));
  return frame;
}

PointCloud some_points() {
  PointCloud cloud;
  for (int i = 0; i < 10; ++i)
    cloud.push_back(Eigen::Vector3f(0.1f, -0.02f, 0.03f) * static_cast<float>(i) + Eigen::Vector3f::UnitZ());
  cloud.width = static_cast<int>(cloud.size());
  return cloud;
}

TEST(FrameMessage, HoldsPointsToAHundredthOfAMillimetre) {
  const PointCloud cloud = some_points();
  const std::vector<std::uint32_t> rgb(cloud.size(), 0x102030);
  const auto made = make_frame_message(frame_of(cloud, rgb), 42, Eigen::Isometry3f::Identity(), {});
  const Read read(std::get<std::string>(made));
  ASSERT_EQ(read.points, cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i)
    EXPECT_LT((read.point(i) - cloud.point(i)).norm(), 2e-5f) << i;
  ASSERT_TRUE(read.colors);
  const std::size_t color = read.data + 6 * cloud.size();
  EXPECT_EQ(read.get<std::uint8_t>(color), 0x10);
  EXPECT_EQ(read.get<std::uint8_t>(color + 2), 0x30);
  EXPECT_EQ(read.get<std::int64_t>(20), 42);
  EXPECT_EQ(read.json.at("channel"), "CLOUDS");
  EXPECT_EQ(read.json.at("seq"), 7);
  EXPECT_FALSE(read.json.contains("list"));
}

TEST(FrameMessage, MovesPointsToTheFrameOfTheList) {
  Eigen::Isometry3f T_base_camera = Eigen::Isometry3f::Identity();
  T_base_camera.translate(Eigen::Vector3f(1, 2, 3));
  T_base_camera.rotate(Eigen::AngleAxisf(1.2f, Eigen::Vector3f::UnitX()));
  MatchedFrame frame = frame_of(some_points());
  frame.list.emplace();
  frame.list->frame_name = "base";
  const auto made = make_frame_message(frame, 1, T_base_camera, {});
  const Read read(std::get<std::string>(made));
  EXPECT_LT((read.point(9) - T_base_camera * some_points().point(9)).norm(), 2e-5f);
  EXPECT_EQ(read.json.at("frame_name"), "base");
  EXPECT_EQ(read.json.at("cloud_frame_name"), "camera");
  EXPECT_FLOAT_EQ(read.json.at("viewpoint").at(1).get<float>(), 2);
  EXPECT_TRUE(read.json.at("list").contains("handles"));
}

TEST(FrameMessage, LeavesOutWhatIsNoPlaceAndThinsOutWhatIsTooMuch) {
  PointCloud cloud = some_points();
  cloud.x[3] = std::numeric_limits<float>::quiet_NaN();
  cloud.z[4] = 1e30f;
  const auto made = make_frame_message(frame_of(cloud), 1, Eigen::Isometry3f::Identity(), {});
  EXPECT_EQ(Read(std::get<std::string>(made)).points, 8u);
  FrameMessageOptions few;
  few.max_points = 4;
  const auto thin = make_frame_message(frame_of(some_points()), 1, Eigen::Isometry3f::Identity(), few);
  EXPECT_EQ(Read(std::get<std::string>(thin)).points, 4u);
}

TEST(FrameMessage, RefusesWhatIsNoCloud) {
  MatchedFrame frame = frame_of(some_points());
  frame.cloud.resize(frame.cloud.size() - 1);
  EXPECT_TRUE(
      std::holds_alternative<Refusal>(make_frame_message(frame, 1, Eigen::Isometry3f::Identity(), {})));
  const auto empty = make_frame_message(frame_of({}), 1, Eigen::Isometry3f::Identity(), {});
  EXPECT_EQ(Read(std::get<std::string>(empty)).points, 0u);
}

}  // namespace
}  // namespace graspd

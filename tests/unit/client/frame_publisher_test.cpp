// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/common/frame_publisher.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <variant>

#include "client/simulate/line_file.hpp"
#include "client/simulate/simulation.hpp"
#include "client/simulate/truth_line.hpp"
#include "service/transport/cloud_decoder.hpp"

namespace graspd {
namespace {

DepthFrame frame() {
  SimulationConfig config;
  config.camera = {160, 120, 131.25, 131.25, 79.5, 59.5};
  config.sensor = *sensor_model("kinect");
  return Simulation(config).frame(0);
}

/// What comes out at the other end of a bus inside this process.
class Looped {
 public:
  Looped() : publisher(bus_, "C") {
    bus_.subscribe("C", [this](const Packet& packet) {
      auto decoded = decode_cloud(packet.bytes, DecodeLimits{});
      if (auto* got = std::get_if<Frame>(&decoded)) received_ = std::move(*got);
    });
  }

  std::optional<Frame> receive() {
    received_.reset();
    (void)bus_.wait(std::chrono::seconds(20));
    return received_;
  }

 private:
  LcmBus bus_{"memq://"};
  std::optional<Frame> received_;

 public:
  FramePublisher publisher;
};

TEST(FramePublisher, CloudsArriveAsTheyWereSent) {
  Looped looped;
  const LabelledCloud sent = to_cloud(frame());
  looped.publisher.send_cloud({123, 45, "camera"}, sent);
  const auto received = looped.receive();
  ASSERT_TRUE(received);
  EXPECT_EQ(received->utime, 123);
  EXPECT_EQ(received->seq, 45);
  EXPECT_EQ(received->frame_name, "camera");
  EXPECT_EQ(received->cloud.width, 160);
  EXPECT_EQ(received->cloud.height, 120);
  ASSERT_EQ(received->cloud.size(), sent.cloud.size());
  for (std::size_t i = 0; i < sent.cloud.size(); ++i) {
    EXPECT_EQ(std::isnan(received->cloud.z[i]), std::isnan(sent.cloud.z[i]));
    if (std::isnan(sent.cloud.z[i])) continue;
    EXPECT_EQ(received->cloud.point(i), sent.cloud.point(i));
  }
}

TEST(FramePublisher, DepthImagesGiveTheSamePointsToAMillimetre) {
  Looped looped;
  const DepthFrame sent = frame();
  looped.publisher.send_depth({1, 2, "camera"}, sent.camera, sent.depth_m, 0.001);
  const auto received = looped.receive();
  ASSERT_TRUE(received);
  const PointCloud expected = to_cloud(sent).cloud;
  ASSERT_EQ(received->cloud.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(std::isnan(received->cloud.z[i]), std::isnan(expected.z[i]));
    if (std::isnan(expected.z[i])) continue;
    EXPECT_LT((received->cloud.point(i) - expected.point(i)).norm(), 0.0008f);
  }
}

TEST(FramePublisher, CountsWhatWentOut) {
  Looped looped;
  EXPECT_EQ(looped.publisher.summary(), "0 frames, 0.0 MB in 0.0 s (0.0 Hz) on C");
  const LabelledCloud cloud = to_cloud(frame());
  looped.publisher.send_cloud({1, 0, "camera"}, cloud);
  EXPECT_EQ(looped.publisher.frames(), 1);
  EXPECT_EQ(looped.publisher.summary(), "1 frames, 0.4 MB in 0.0 s (0.0 Hz) on C");
}

TEST(Pacer, KeepsItsSlotsAndDoesNotMakeUpForLostOnes) {
  Pacer pacer(50);
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < 6; ++i) EXPECT_TRUE(pacer.next());
  EXPECT_GE(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(100));
}

TEST(TruthLine, ListsTheObjectsThatWereMeasured) {
  const DepthFrame seen = frame();
  const std::string line = truth_line(3, seen);
  EXPECT_TRUE(line.starts_with("{\"seq\":3,\"objects\":[{\"label\":")) << line.substr(0, 60);
  EXPECT_EQ(line.back(), '\n');
  EXPECT_THROW(LineFile("/no/such/folder/truth.json"), std::runtime_error);
}

}  // namespace
}  // namespace graspd

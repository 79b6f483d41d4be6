// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What is published of the segments, and when.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "service/transport/handle_list_codec.hpp"
#include "service/transport/segmentation_codec.hpp"
#include "service/transport/segmentation_request_codec.hpp"
#include "tests/unit/daemon/running_daemon.hpp"

namespace graspd {
namespace {

using namespace std::chrono_literals;

class SegmentsTest : public RunningDaemon {
 protected:
  SegmentsTest() {
    bus_.subscribe("GRASPD_SEGMENTS", [this](const Packet& packet) {
      auto decoded = decode_segmentation(packet.bytes);
      ASSERT_TRUE(decoded.has_value());
      ASSERT_FALSE(answers_.empty());
      EXPECT_EQ(answers_.back().seq, decoded->seq) << "not right after its handle list";
      segmentations_.push_back(std::move(*decoded));
    });
  }

  static ServiceConfig publishing(PublishSegments when) {
    ServiceConfig config;
    config.sources[0].publish_segments = when;
    return config;
  }
  /// The answer to one frame. What follows it has been received, too: it comes before the next answer.
  handle_list_t answer_to(const Bytes& frame) {
    const std::size_t before = answers_.size();
    send("GRASPD_CLOUD", frame);
    run_until_answers(before + 1);
    send("GRASPD_CLOUD", cloud_message(1000, PointCloud{}));
    run_until_answers(before + 2);
    return answers_[before];
  }
  void request(const std::string& channel, double seconds) {
    send("GRASPD_REQUESTS", encode(segmentation_request_t{0, channel, seconds}));
    receive_rest();
    daemon_->step();
  }

  std::vector<segmentation_t> segmentations_;
};

/// Without times.
Bytes same_parts(handle_list_t list) {
  list.latency = 0;
  list.stages.clear();
  list.num_stages = 0;
  return encode(list);
}

TEST_F(SegmentsTest, NobodyAsksAndNothingComes) {
  start({});
  EXPECT_EQ(answer_to(cloud_message(1, box_on_table())).status, +handle_list_t::OK);
  EXPECT_TRUE(segmentations_.empty());
}

TEST_F(SegmentsTest, OnRequestForAsLongAsItHolds) {
  start({});
  const handle_list_t plain = answer_to(cloud_message(1, box_on_table()));
  ASSERT_TRUE(segmentations_.empty());
  request("GRASPD_CLOUD", 30);
  const handle_list_t list = answer_to(cloud_message(1, box_on_table()));
  ASSERT_EQ(segmentations_.size(), 1u);
  EXPECT_EQ(same_parts(list), same_parts(plain));
  const segmentation_t& segmentation = segmentations_[0];
  EXPECT_EQ(segmentation.seq, list.seq);
  EXPECT_EQ(segmentation.utime, list.utime);
  EXPECT_EQ(segmentation.source_channel, list.source_channel);
  EXPECT_EQ(segmentation.frame_name, list.frame_name);
  EXPECT_EQ(segmentation.config_revision, list.config_revision);
  EXPECT_LT(segmentation.num_points, list.points_used);
  EXPECT_EQ(segmentation.num_segments, list.num_segments);
  clock_.advance(31s);
  EXPECT_EQ(answer_to(cloud_message(2, box_on_table())).status, +handle_list_t::OK);
  EXPECT_EQ(segmentations_.size(), 1u) << "the request is over";
}

TEST_F(SegmentsTest, AnotherSourcesRequestIsNotOurs) {
  start({});
  request("OTHER_CLOUD", 30);
  EXPECT_EQ(answer_to(cloud_message(1, box_on_table())).status, +handle_list_t::OK);
  EXPECT_TRUE(segmentations_.empty());
  request("", 30);
  EXPECT_EQ(answer_to(cloud_message(2, box_on_table())).status, +handle_list_t::OK);
  EXPECT_EQ(segmentations_.size(), 1u);
}

TEST_F(SegmentsTest, AlwaysNeedsNoRequestAndNeverTakesNone) {
  start(publishing(PublishSegments::kAlways));
  EXPECT_EQ(answer_to(cloud_message(1, box_on_table())).status, +handle_list_t::OK);
  EXPECT_EQ(segmentations_.size(), 1u);
}

TEST_F(SegmentsTest, NeverTakesNoRequest) {
  start(publishing(PublishSegments::kNever));
  request("", 30);
  EXPECT_EQ(answer_to(cloud_message(1, box_on_table())).status, +handle_list_t::OK);
  EXPECT_TRUE(segmentations_.empty());
}

TEST_F(SegmentsTest, FramesThatWereNotWorkedOnHaveNone) {
  start(publishing(PublishSegments::kAlways));
  EXPECT_EQ(answer_to(cloud_message(1, PointCloud{})).status, +handle_list_t::EMPTY_CLOUD);
  EXPECT_EQ(answer_to(Bytes(20)).status, +handle_list_t::REFUSED);
  EXPECT_TRUE(segmentations_.empty());
  EXPECT_EQ(answer_to(depth_message(2, 1)).status, +handle_list_t::NO_HANDLES);
  EXPECT_EQ(segmentations_.size(), 1u);
}

TEST_F(SegmentsTest, NonsenseOnTheRequestChannelIsRefused) {
  start({});
  send("GRASPD_REQUESTS", Bytes(30));
  run_until([&] { return logged("request_refused"); });
  EXPECT_EQ(answer_to(cloud_message(1, box_on_table())).status, +handle_list_t::OK);
  EXPECT_TRUE(segmentations_.empty());
}

TEST_F(SegmentsTest, HandlesAreOnTheirSegments) {
  start(publishing(PublishSegments::kAlways));
  const handle_list_t list = answer_to(cloud_message(1, box_on_table()));
  ASSERT_EQ(segmentations_.size(), 1u);
  const segmentation_t& segmentation = segmentations_[0];
  std::vector<int> points(static_cast<std::size_t>(segmentation.num_segments));
  int support = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(segmentation.num_points); ++i) {
    const SegmentedPoint point = segmented_point(segmentation, i);
    if (point.segment >= 0) ++points[static_cast<std::size_t>(point.segment)];
    EXPECT_TRUE(!point.is_support || std::abs(point.position.z() - 0.6) < 0.01);
    support += point.is_support ? 1 : 0;
  }
  EXPECT_GT(support, 300);
  for (const segment_t& segment : segmentation.segments)
    EXPECT_EQ(segment.num_points, points[static_cast<std::size_t>(segment.id)]);
  for (const handle_t& handle : list.handles) {
    const segment_t& segment = segmentation.segments.at(static_cast<std::size_t>(handle.segment_id));
    EXPECT_GT(segment.num_handles, 0);
    EXPECT_NEAR(handle.position[2], segment.centroid[2], 0.02);
  }
}

}  // namespace
}  // namespace graspd

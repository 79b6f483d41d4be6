// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The whole daemon in one process, over memq://.
#include "service/daemon/daemon.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "service/transport/handle_list_codec.hpp"
#include "service/transport/status_codec.hpp"
#include "tests/unit/daemon/messages.hpp"
#include "tests/unit/daemon/running_daemon.hpp"

namespace graspd {
namespace {

using namespace std::chrono_literals;

using DaemonTest = RunningDaemon;

TEST_F(DaemonTest, AnswersCloudsAndDepthImages) {
  start({});
  send("GRASPD_CLOUD", cloud_message(1, box_on_table()));
  run_until_answers(1);
  EXPECT_EQ(answers_[0].status, +handle_list_t::OK) << answers_[0].status_text;
  EXPECT_GT(answers_[0].latency, 0);
  send("GRASPD_CLOUD", depth_message(2, 1));
  run_until_answers(2);
  EXPECT_EQ(answers_[1].status, +handle_list_t::NO_HANDLES);
  EXPECT_EQ(answers_[1].source_channel, "GRASPD_CLOUD");
}

TEST_F(DaemonTest, TheSameHandlesForAnyNumberOfThreadsAndWorkers) {
  std::vector<Bytes> seen;
  for (const int workers : {1, 2, 4}) {
    ServiceConfig config;
    config.threads = workers;
    config.workers = workers;
    LcmBus bus("memq://");
    Daemon daemon(config, bus, clock_, log_);
    std::optional<handle_list_t> answer;
    bus.subscribe("GRASPD_HANDLES", [&](const Packet& packet) { answer = decode_handle_list(packet.bytes); });
    ASSERT_TRUE(bus.publish("GRASPD_CLOUD", cloud_message(1, box_on_table())));
    const auto deadline = std::chrono::steady_clock::now() + 120s;
    while (!answer && std::chrono::steady_clock::now() < deadline) daemon.step();
    ASSERT_TRUE(answer);
    answer->latency = 0;
    answer->stages.clear();
    answer->num_stages = 0;
    seen.push_back(encode(*answer));
  }
  EXPECT_EQ(seen[1], seen[0]);
  EXPECT_EQ(seen[2], seen[0]);
}

TEST_F(DaemonTest, StatusEverySecondWithoutTraffic) {
  start({});
  run_until([&] { return statuses_.size() >= 3; });
  EXPECT_EQ(statuses_[0].state, +status_t::RUNNING);
  EXPECT_EQ(statuses_[0].num_workers, 2);
  ASSERT_EQ(statuses_[0].num_sources, 1);
  EXPECT_EQ(statuses_[0].sources[0].channel, "GRASPD_CLOUD");
  EXPECT_GE(statuses_[2].utime - statuses_[0].utime, 1'900'000);
}

class DaemonPolicy : public DaemonTest, public testing::WithParamInterface<FramePolicy> {};

TEST_P(DaemonPolicy, EveryFrameIsAnsweredInOrderWhenTheyComeTooFast) {
  ServiceConfig config;
  config.sources[0].queue_length = 3;
  config.sources[0].policy = GetParam();
  start(config);
  constexpr std::int64_t kFrames = 20;
  for (std::int64_t seq = 0; seq < kFrames; ++seq) {
    send("GRASPD_CLOUD", cloud_message(seq, box_on_table()));
    daemon_->step();
  }
  run_until_answers(kFrames);
  EXPECT_EQ(answered_seqs(), numbers_to(kFrames));
  EXPECT_EQ(answers_.back().status, +handle_list_t::OK);
  std::int64_t dropped = 0;
  for (const handle_list_t& list : answers_) {
    dropped += list.status == +handle_list_t::OVERLOADED ? 1 : 0;
    EXPECT_TRUE(list.status == +handle_list_t::OK || list.status == +handle_list_t::OVERLOADED);
  }
  EXPECT_TRUE(daemon_->stop());
  receive_rest();
  const source_status_t& source = statuses_.back().sources[0];
  EXPECT_EQ(source.received, kFrames);
  EXPECT_EQ(source.dropped, dropped);
  EXPECT_EQ(source.processed, kFrames - dropped);
  EXPECT_EQ(source.lost, 0);
}

INSTANTIATE_TEST_SUITE_P(Policies, DaemonPolicy, testing::Values(FramePolicy::kLatest, FramePolicy::kAll),
                         [](const auto& policy) {
                           return std::string(choices(policy.param)[static_cast<std::size_t>(policy.param)]);
                         });

TEST_F(DaemonTest, UnusableMessagesNeverReplaceAFrame) {
  start({});
  Bytes truncated = cloud_message(100, box_on_table());
  truncated.pop_back();
  send("GRASPD_CLOUD", cloud_message(0, box_on_table()));
  send("GRASPD_CLOUD", cloud_message(1, box_on_table()));
  for (int i = 0; i < 10; ++i) send("GRASPD_CLOUD", truncated);
  send("GRASPD_CLOUD", Bytes{});
  run_until_answers(13);
  EXPECT_EQ(answers_[1].status, +handle_list_t::OK) << "the frame that waited";
  for (std::size_t i = 2; i < 13; ++i) EXPECT_EQ(answers_[i].status, +handle_list_t::REFUSED);
  const std::lock_guard lock(lines_mutex_);
  EXPECT_EQ(lines_.size(), static_cast<std::size_t>(Log::kLinesAPeriod));
}

TEST_F(DaemonTest, TooLargeMessagesAreRefusedWithTheirHeader) {
  ServiceConfig config;
  config.limits.decode.max_message_bytes = 2048;
  start(config);
  send("GRASPD_CLOUD", cloud_message(42, box_on_table()));
  run_until_answers(1);
  EXPECT_EQ(answers_[0].status, +handle_list_t::REFUSED);
  EXPECT_EQ(answers_[0].seq, 42);
  EXPECT_EQ(answers_[0].frame_name, "camera");
}

TEST_F(DaemonTest, ARegularExpressionMakesOneStreamAChannel) {
  ServiceConfig config;
  config.limits.max_sources = 3;
  config.sources[0].channel = "CAM_[0-9]+";
  start(config);
  const Bytes empty = cloud_message(7, PointCloud{});
  for (const char* channel : {"CAM_1", "CAM_22", "CAM_3", "CAM_4", "CAM_X", "MY_CAM_1", "CAM_1"})
    send(channel, empty);
  run_until_answers(4);
  run_until([&] {
    return !statuses_.empty() && statuses_.back().ignored == 1 && statuses_.back().num_sources == 3;
  });
  std::map<std::string, std::int64_t> received;
  for (const source_status_t& source : statuses_.back().sources) received[source.channel] = source.received;
  EXPECT_EQ(received, (std::map<std::string, std::int64_t>{{"CAM_1", 2}, {"CAM_22", 1}, {"CAM_3", 1}}));
  EXPECT_EQ(answers_.size(), 4u);
}

TEST_F(DaemonTest, TheFirstOfTwoSourcesHasTheChannel) {
  ServiceConfig config;
  config.sources.push_back(config.sources[0]);
  config.sources[0].channel = "A_.*";
  config.sources[0].handles_channel = "FIRST_HANDLES";
  config.sources[1].name = "second";
  config.sources[1].channel = ".*_B";
  config.sources[1].handles_channel = "SECOND_HANDLES";
  config.sources[1].sensor_pose.frame_name = "base";
  start(config);
  send("A_B", cloud_message(1, PointCloud{}));
  send("C_B", cloud_message(2, PointCloud{}));
  run_until_answers(2);
  receive_rest();
  ASSERT_EQ(answers_.size(), 2u);
  for (const handle_list_t& list : answers_) EXPECT_EQ(list.frame_name, list.seq == 1 ? "camera" : "base");
}

TEST_F(DaemonTest, NeverListensToItself) {
  // Such a configuration is refused at load; here it is forced on the daemon.
  ServiceConfig config;
  config.sources[0].channel = ".*";
  start(config);
  send("GRASPD_CLOUD", cloud_message(1, PointCloud{}));
  run_until([&] { return statuses_.size() >= 2; });
  EXPECT_EQ(answers_.size(), 1u);
  EXPECT_EQ(statuses_.back().num_sources, 1);
  EXPECT_EQ(statuses_.back().sources[0].refused, 0);
}

TEST_F(DaemonTest, MissingNumbersAreLost) {
  start({});
  for (const int seq : {1, 2, 5, 6, 10}) {
    send("GRASPD_CLOUD", cloud_message(seq, PointCloud{}));
    run_until_answers(answers_.size() + 1);
  }
  run_until([&] { return !statuses_.empty() && statuses_.back().sources[0].received == 5; });
  EXPECT_EQ(statuses_.back().sources[0].lost, 2 + 3);
}

class DaemonStop : public DaemonTest, public testing::WithParamInterface<StopPolicy> {};

TEST_P(DaemonStop, AnswersAllItTookAndSaysSo) {
  ServiceConfig config;
  config.on_stop = GetParam();
  config.workers = 1;
  config.sources[0].policy = FramePolicy::kAll;
  start(config);
  constexpr std::int64_t kFrames = 12;
  for (std::int64_t seq = 0; seq < kFrames; ++seq) {
    send("GRASPD_CLOUD", cloud_message(seq, box_on_table()));
    daemon_->step();
  }
  run_until_answers(1);
  static_cast<void>(daemon_->stop());
  receive_rest();
  const status_t& last = statuses_.back();
  EXPECT_EQ(last.state, +status_t::STOPPING);
  EXPECT_EQ(last.sources[0].pending, 0);
  EXPECT_EQ(static_cast<std::int64_t>(answers_.size()), last.sources[0].received);
  EXPECT_EQ(answered_seqs(), numbers_to(last.sources[0].received));
  for (const handle_list_t& list : answers_)
    EXPECT_TRUE(list.status == +handle_list_t::OK || list.status_text == "graspd stops") << list.status_text;
}

INSTANTIATE_TEST_SUITE_P(Policies, DaemonStop, testing::Values(StopPolicy::kFinish, StopPolicy::kDrop),
                         [](const auto& policy) {
                           return std::string(choices(policy.param)[static_cast<std::size_t>(policy.param)]);
                         });

}  // namespace
}  // namespace graspd

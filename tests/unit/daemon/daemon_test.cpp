// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The whole daemon in one process, over memq://.
#include "service/daemon/daemon.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "service/transport/handle_list_codec.hpp"
#include "service/transport/status_codec.hpp"
#include "tests/unit/daemon/messages.hpp"

namespace graspd {
namespace {

using namespace std::chrono_literals;

// ThreadSanitizer cannot see what Debian's libtbb orders (service/runtime/tsan_suppressions.cpp), and to
// suppress its reports takes minutes: there a frame has one thread. Workers, gates and the bus run side by
// side as ever.
#ifdef __SANITIZE_THREAD__
constexpr int kMostThreads = 1;
#else
constexpr int kMostThreads = 4;
#endif

class DaemonTest : public testing::Test {
 protected:
  DaemonTest() {
    bus_.subscribe(".*_HANDLES", [this](const Packet& packet) {
      const auto list = decode_handle_list(packet.bytes);
      ASSERT_TRUE(list);
      answers_.push_back(*list);
    });
    bus_.subscribe("GRASPD_STATUS", [this](const Packet& packet) {
      const auto status = decode_status(packet.bytes);
      ASSERT_TRUE(status);
      statuses_.push_back(*status);
    });
  }

  void start(ServiceConfig config) {
    config.threads = std::min(2, kMostThreads);
    daemon_ = std::make_unique<Daemon>(std::move(config), bus_, clock_, log_);
  }

  void send(const std::string& channel, const Bytes& bytes) { ASSERT_TRUE(bus_.publish(channel, bytes)); }

  template <class Condition>
  void run_until(Condition condition) {
    const auto deadline = std::chrono::steady_clock::now() + 120s;
    while (!condition()) {
      ASSERT_LT(std::chrono::steady_clock::now(), deadline) << "waited in vain";
      daemon_->step();
    }
  }
  void run_until_answers(std::size_t count) {
    run_until([&] { return answers_.size() >= count; });
  }
  /// What the daemon sent, without its doing anything more.
  void receive_rest() {
    while (bus_.wait(0ms) == LcmBus::Wait::kHandled) {
    }
  }
  [[nodiscard]] std::vector<std::int64_t> answered_seqs() const {
    std::vector<std::int64_t> seqs;
    for (const handle_list_t& list : answers_) seqs.push_back(list.seq);
    return seqs;
  }

  LcmBus bus_{"memq://"};
  SystemClock clock_;
  std::vector<std::string> lines_;
  std::mutex lines_mutex_;
  Log log_{clock_, [this](const std::string& line) {
             const std::lock_guard lock(lines_mutex_);
             lines_.push_back(line);
           }};
  std::vector<handle_list_t> answers_;
  std::vector<status_t> statuses_;
  std::unique_ptr<Daemon> daemon_;  // last: it stops before what it uses goes
};

std::vector<std::int64_t> numbers_to(std::int64_t count) {
  std::vector<std::int64_t> numbers;
  for (std::int64_t i = 0; i < count; ++i) numbers.push_back(i);
  return numbers;
}

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
    config.threads = std::min(workers, kMostThreads);
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

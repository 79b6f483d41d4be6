// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The daemon when there is too much to do, when frames hang, and when the clock is set.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <string>

#include "tests/unit/daemon/running_daemon.hpp"

namespace graspd {
namespace {

using namespace std::chrono_literals;

class DaemonLoadTest : public RunningDaemon {
 protected:
  DaemonLoadTest() {
    config_.workers = 1;
    config_.watchdog_s = 0;
  }
  SourceConfig& source() { return config_.sources[0]; }
  [[nodiscard]] std::int64_t dropped_for(const std::string& reason) const {
    for (const reason_count_t& entry : statuses_.back().sources[0].drops)
      if (entry.reason == reason) return entry.count;
    return 0;
  }
  ServiceConfig config_;
};

TEST_F(DaemonLoadTest, AFrameThatHasWaitedTooLongIsNotWorkedOn) {
  source().policy = FramePolicy::kAll;
  source().deadline_ms = 10'000;
  start(config_);
  hold_frame(0);
  send_and_step(1);
  send_and_step(2);
  clock_.advance(5s);
  send_and_step(3);
  clock_.advance(6s);
  clock_.release();
  run_until_answers(4);
  EXPECT_EQ(answered_seqs(), numbers_to(4));
  for (const std::size_t late : {1u, 2u}) {
    EXPECT_EQ(answers_[late].status, +handle_list_t::OVERLOADED);
    EXPECT_EQ(answers_[late].num_stages, 0);
    EXPECT_NE(answers_[late].status_text.find("longer than deadline_ms"), std::string::npos);
  }
  EXPECT_EQ(answers_[3].status, +handle_list_t::OK) << answers_[3].status_text;
  run_until_status();
  EXPECT_GE(dropped_for("deadline"), 2);
}

TEST_F(DaemonLoadTest, AFrameThatTakesTooLongIsAnsweredAtItsDeadlineAndOnce) {
  source().deadline_ms = 10'000;
  start(config_);
  hold_frame(0);
  clock_.advance(11s);
  run_until_answers(1);
  EXPECT_EQ(answers_[0].status, +handle_list_t::OVERLOADED);
  EXPECT_NE(answers_[0].status_text.find("not done 11"), std::string::npos) << answers_[0].status_text;
  EXPECT_GE(answers_[0].latency, 11);
  clock_.release();
  send("GRASPD_CLOUD", cloud_message(1, box_on_table()));
  run_until_answers(2);
  EXPECT_EQ(answers_[1].status, +handle_list_t::OK);
  receive_rest();
  EXPECT_EQ(answered_seqs(), numbers_to(2));
}

TEST_F(DaemonLoadTest, AStuckFrameIsToldAndTheRestGoesOn) {
  config_.workers = 2;
  config_.watchdog_s = 10;
  source().policy = FramePolicy::kAll;
  start(config_);
  hold_frame(0);
  EXPECT_EQ(daemon_->num_stuck(), 0);
  clock_.advance(11s);
  run_until_answers(1);
  EXPECT_EQ(answers_[0].status, +handle_list_t::FAILED);
  EXPECT_NE(answers_[0].status_text.find("watchdog_s"), std::string::npos);
  EXPECT_EQ(daemon_->num_stuck(), 1);
  EXPECT_TRUE(logged("event=frame_stuck channel=GRASPD_CLOUD seq=0"));
  run_until_status();
  EXPECT_EQ(statuses_.back().state, +status_t::STUCK);
  EXPECT_EQ(statuses_.back().num_stuck, 1);
  EXPECT_EQ(statuses_.back().sources[0].failed, 1);
  // The other worker goes on meanwhile.
  send("GRASPD_CLOUD", cloud_message(1, box_on_table()));
  run_until_answers(2);
  EXPECT_EQ(answers_[1].status, +handle_list_t::OK);
  clock_.release();
  run_until([this] { return daemon_->num_stuck() == 0; });
  run_until_status();
  run_until_status();
  EXPECT_EQ(statuses_.back().state, +status_t::RUNNING);
  EXPECT_EQ(answers_.size(), 2u);
}

TEST_F(DaemonLoadTest, AnswersThatWaitForOneSlowFrameAreBounded) {
  config_.limits.max_waiting_answers = 4;
  start(config_);
  hold_frame(0);
  constexpr std::int64_t kFrames = 50;
  for (std::int64_t seq = 1; seq < kFrames; ++seq) send_and_step(seq);
  receive_rest();
  EXPECT_GE(answers_.size(), static_cast<std::size_t>(kFrames - 6)) << "they do not pile up";
  EXPECT_EQ(answers_[0].status, +handle_list_t::OVERLOADED);
  EXPECT_NE(answers_[0].status_text.find("too many later answers"), std::string::npos);
  clock_.release();
  run_until_answers(kFrames);
  EXPECT_EQ(answered_seqs(), numbers_to(kFrames));
  EXPECT_EQ(answers_.back().status, +handle_list_t::OK);
  run_until_status();
  EXPECT_EQ(dropped_for("held_up"), 1);
  EXPECT_TRUE(logged("event=answers_held_up"));
}

TEST_F(DaemonLoadTest, RefusedMessagesCannotPileUpBehindAFrameEither) {
  config_.limits.max_waiting_answers = 4;
  source().policy = FramePolicy::kAll;
  start(config_);
  hold_frame(0);
  send_and_step(1);
  for (int i = 0; i < 100; ++i) send("GRASPD_CLOUD", Bytes(3));
  run_until_answers(95);
  EXPECT_EQ(answers_[1].seq, 1);
  EXPECT_NE(answers_[1].status_text.find("too many later answers"), std::string::npos);
  clock_.release();
  run_until_answers(102);
}

TEST_F(DaemonLoadTest, BytesThatWaitAreBoundedAndTheNewestFrameIsKept) {
  const auto size = static_cast<int>(cloud_message(0, box_on_table()).size());
  config_.limits.max_waiting_bytes = 2 * size + size / 2;
  source().policy = FramePolicy::kAll;
  start(config_);
  hold_frame(0);
  for (std::int64_t seq = 1; seq < 6; ++seq) send_and_step(seq);
  run_until_status();
  EXPECT_EQ(statuses_.back().waiting_bytes, 2 * size);
  clock_.release();
  run_until_answers(6);
  EXPECT_EQ(answered_seqs(), numbers_to(6));
  for (const std::size_t kept : {0u, 5u}) EXPECT_EQ(answers_[kept].status, +handle_list_t::OK);
  run_until_status();
  run_until_status();
  EXPECT_EQ(dropped_for("memory"), 4);
  EXPECT_EQ(statuses_.back().waiting_bytes, 0);
}

TEST_F(DaemonLoadTest, AMessageLargerThanAllThatMayWaitIsAnswered) {
  config_.limits.max_waiting_bytes = 1000;
  start(config_);
  send("GRASPD_CLOUD", cloud_message(0, box_on_table()));
  run_until_answers(1);
  EXPECT_EQ(answers_[0].status, +handle_list_t::OVERLOADED);
  EXPECT_EQ(answers_[0].status_text, "too many bytes wait");
}

TEST_F(DaemonLoadTest, CoarserVoxelsWhileFramesCannotKeepUp) {
  source().policy = FramePolicy::kAll;
  source().degrade.voxel_m = 0.006;
  source().degrade.above_ms = 20'000;
  source().degrade.below_ms = 10'000;
  source().degrade.hold_s = 60;
  start(config_);
  const auto answer_one = [this] {
    send("GRASPD_CLOUD", cloud_message(static_cast<std::int64_t>(answers_.size()), box_on_table()));
    run_until_answers(answers_.size() + 1);
  };
  answer_one();
  // Frames that take half a minute each.
  while (!logged("event=degraded channel=GRASPD_CLOUD")) {
    ASSERT_LT(answers_.size(), 10u);
    const std::size_t count = answers_.size();
    hold_frame(static_cast<std::int64_t>(count));
    clock_.advance(30s);
    clock_.release();
    run_until_answers(count + 1);
  }
  for (const handle_list_t& list : answers_) EXPECT_EQ(list.degraded, 0);
  answer_one();
  EXPECT_EQ(answers_.back().degraded, 1);
  EXPECT_FLOAT_EQ(static_cast<float>(answers_.back().voxel_size), 0.006f);
  EXPECT_EQ(answers_.back().status, +handle_list_t::OK);
  run_until_status();
  EXPECT_EQ(statuses_.back().sources[0].degraded, 1);
  EXPECT_EQ(statuses_.back().sources[0].coarse, 1);
  for (int i = 0; i < 10; ++i) answer_one();
  EXPECT_EQ(answers_.back().degraded, 1) << "held";
  clock_.advance(60s);
  answer_one();
  answer_one();
  EXPECT_EQ(answers_.back().degraded, 0);
  EXPECT_TRUE(logged("event=recovered channel=GRASPD_CLOUD"));
}

TEST_F(DaemonLoadTest, NeitherDeadlinesNorLatenciesFollowTheWallClock) {
  source().policy = FramePolicy::kAll;
  source().deadline_ms = 60'000;
  config_.watchdog_s = 60;
  start(config_);
  run_until_status();
  std::int64_t seq = 0;
  for (const auto jump : {-3600s, 5s, 9s, 3600s, -9s}) {
    clock_.set_wall(jump);
    for (int i = 0; i < 3; ++i) {
      send("GRASPD_CLOUD", cloud_message(seq++, box_on_table()));
      run_until_answers(static_cast<std::size_t>(seq));
      EXPECT_EQ(answers_.back().status, +handle_list_t::OK) << answers_.back().status_text;
      EXPECT_GE(answers_.back().latency, 0);
    }
  }
  run_until_status();
  EXPECT_TRUE(logged("event=clock_set by_us=-36"));
  EXPECT_GE(statuses_.back().uptime, 0);
  EXPECT_LT(statuses_.back().uptime, 600);
  EXPECT_EQ(dropped_for("deadline"), 0);
}

TEST_F(DaemonLoadTest, SourcesMayChangeTypeAndSizeAtAnyFrame) {
  source().policy = FramePolicy::kAll;
  start(config_);
  send("GRASPD_CLOUD", cloud_message(0, box_on_table()));
  send("GRASPD_CLOUD", depth_message(1, 1));
  send("GRASPD_CLOUD", cloud_message(2, uniform_cloud(10, 0.5f)));
  send("GRASPD_CLOUD", Bytes(5));
  send("GRASPD_CLOUD", cloud_message(4, box_on_table()));
  send("GRASPD_CLOUD", depth_message(5, 0));
  run_until_answers(6);
  std::vector<std::int8_t> states;
  for (const handle_list_t& list : answers_) states.push_back(list.status);
  EXPECT_EQ(states, (std::vector<std::int8_t>{handle_list_t::OK, handle_list_t::NO_HANDLES,
                                              handle_list_t::NO_HANDLES, handle_list_t::REFUSED,
                                              handle_list_t::OK, handle_list_t::NO_FINITE_POINTS}));
}

}  // namespace
}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/daemon/health.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <thread>
#include <vector>

#include "tests/unit/runtime/manual_clock.hpp"

namespace graspd {
namespace {

using namespace std::chrono_literals;

Answer answer(Outcome outcome, std::optional<RefusalReason> refusal = std::nullopt, const char* text = "") {
  Answer a{};
  a.outcome = outcome;
  a.refusal = refusal;
  a.status_text = text;
  return a;
}

Answer dropped(DropReason reason) {
  Answer a = answer(Outcome::kDropped);
  a.drop = reason;
  return a;
}

TEST(ChannelHealth, NothingYet) {
  ManualClock clock;
  const source_status_t status = ChannelHealth().snapshot(clock.now());
  EXPECT_EQ(
      status.received + status.processed + status.dropped + status.refused + status.pending + status.lost, 0);
  EXPECT_EQ(status.latency_p50, 0);
  EXPECT_EQ(status.age, -1);
  EXPECT_EQ(status.num_refusals, 0);
  EXPECT_EQ(status.last_error, "");
}

TEST(ChannelHealth, CountsEveryOutcome) {
  ManualClock clock;
  ChannelHealth health;
  static_cast<void>(health.snapshot(clock.now()));
  for (const int seq : {10, 11, 14, -1, 15, 16, 17}) health.received(seq, clock.now());
  Answer coarse = answer(Outcome::kProcessed);
  coarse.degraded = true;
  health.answered(coarse, 0.020);
  health.answered(answer(Outcome::kFailed, std::nullopt, "bad luck"), 0.030);
  health.answered(dropped(DropReason::kNewerFrame), 9);
  health.answered(dropped(DropReason::kDeadline), 9);
  health.answered(answer(Outcome::kRefused, RefusalReason::kTruncated, "truncated: short"), 9);
  health.answered(answer(Outcome::kRefused, RefusalReason::kTruncated, "truncated: shorter"), 9);
  clock.advance(2s);
  const source_status_t status = health.snapshot(clock.now());
  EXPECT_EQ(status.received, 7);
  EXPECT_EQ(status.processed, 2);
  EXPECT_EQ(status.failed, 1);
  EXPECT_EQ(status.coarse, 1);
  EXPECT_EQ(status.dropped, 2);
  ASSERT_EQ(status.num_drops, 2);
  EXPECT_EQ(status.drops[0].reason, "newer_frame");
  EXPECT_EQ(status.drops[1].reason, "deadline");
  EXPECT_EQ(status.drops[1].count, 1);
  EXPECT_EQ(status.refused, 2);
  EXPECT_EQ(status.pending, 1);
  EXPECT_EQ(status.lost, 2);
  EXPECT_DOUBLE_EQ(status.rate, 3.5);
  EXPECT_DOUBLE_EQ(status.age, 2);
  EXPECT_EQ(status.latency_p50, 0.020);
  EXPECT_EQ(status.latency_p99, 0.030);
  ASSERT_EQ(status.num_refusals, 1);
  EXPECT_EQ(status.refusals[0].reason, "truncated");
  EXPECT_EQ(status.refusals[0].count, 2);
  EXPECT_EQ(status.last_error, "truncated: shorter");
}

TEST(ChannelHealth, CountsAddUpWhileOthersCount) {
  ManualClock clock;
  ChannelHealth health;
  constexpr int kMessages = 2000;
  std::vector<std::thread> threads;
  for (int t = 0; t < 2; ++t) {
    threads.emplace_back([&health, &clock] {
      for (int i = 0; i < kMessages; ++i) {
        health.received(i, clock.now());
        health.answered(answer(static_cast<Outcome>(i % 4)), 0.01);
      }
    });
  }
  for (int i = 0; i < 200; ++i) {
    const source_status_t status = health.snapshot(clock.now());
    ASSERT_EQ(status.received, status.processed + status.dropped + status.refused + status.pending);
    ASSERT_GE(status.pending, 0);
  }
  for (std::thread& thread : threads) thread.join();
  const source_status_t status = health.snapshot(clock.now());
  EXPECT_EQ(status.received, 2 * kMessages);
  EXPECT_EQ(status.pending, 0);
}

TEST(ProcessHealth, SaysWhoAndHowLong) {
  ManualClock clock;
  Log log(clock, [](const std::string&) {});
  ProcessHealth health(clock);
  clock.advance(90s);
  log.warning("lcm_away", {{"reason", "cable"}});
  const status_t status = health.snapshot(status_t::STOPPING, std::vector<source_status_t>(2), log);
  EXPECT_EQ(status.state, +status_t::STOPPING);
  EXPECT_EQ(status.pid, getpid());
  EXPECT_EQ(status.uptime, 90);
  EXPECT_EQ(status.utime, clock.wall_utime());
  EXPECT_EQ(status.num_sources, 2);
  EXPECT_GT(status.rss, 0);
  EXPECT_GT(status.num_threads, 0);
  EXPECT_GT(status.num_descriptors, 0);
  EXPECT_GE(status.receive_errors, 0);
  ASSERT_EQ(status.num_errors, 1);
  EXPECT_EQ(status.errors[0].event, "lcm_away");
  EXPECT_EQ(status.errors[0].text, "event=lcm_away reason=cable");
  EXPECT_FALSE(status.version.empty());
  EXPECT_FALSE(status.host.empty());
}

}  // namespace
}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/runtime/frame_queue.hpp"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <future>
#include <thread>
#include <vector>

namespace graspd {
namespace {

using namespace std::chrono_literals;

TEST(FrameQueue, SourcesTakeTurns) {
  FrameQueue<int> queue;
  // One source that never runs dry beside two that send a single frame: counted turns, no clock.
  const std::size_t busy = queue.add_source(100, 100);
  const std::size_t quiet = queue.add_source(1, 1);
  const std::size_t rare = queue.add_source(1, 1);
  for (int i = 0; i < 100; ++i) ASSERT_FALSE(queue.push(busy, i));
  ASSERT_FALSE(queue.push(quiet, 1000));
  ASSERT_FALSE(queue.push(rare, 2000));
  std::vector<std::size_t> turns;
  for (int i = 0; i < 5; ++i) turns.push_back(queue.take()->source);
  EXPECT_EQ(turns, (std::vector<std::size_t>{busy, quiet, rare, busy, busy}));
}

TEST(FrameQueue, NoSourceStarvesBesideFullOnes) {
  FrameQueue<int> queue;
  constexpr std::size_t kSources = 5;
  for (std::size_t s = 0; s < kSources; ++s) queue.add_source(4, 4);
  std::array<int, kSources> served{};
  for (int round = 0; round < 1000; ++round) {
    // Everybody's mailbox is full before every single take.
    for (std::size_t s = 0; s < kSources; ++s) {
      for (int i = 0; i < 4; ++i) static_cast<void>(queue.push(s, i));
    }
    const auto taken = queue.take();
    ++served[taken->source];
    queue.done(taken->source);
  }
  for (const int turns : served) EXPECT_EQ(turns, 200);
}

TEST(FrameQueue, SourcesAtDifferentRatesShareFairly) {
  // Four cameras that send every 3, 6, 12 and 30 ticks, one worker that needs 4 ticks a frame: room for a
  // quarter of a frame a tick. The slowest asks for less than its share and gets all of it; the others share
  // the rest.
  constexpr std::array<int, 4> kPeriods{3, 6, 12, 30};
  constexpr int kTicks = 60000, kWork = 4;
  FrameQueue<int> queue;
  for (std::size_t s = 0; s < kPeriods.size(); ++s) queue.add_source(1, 1);
  std::array<int, 4> sent{}, served{};
  int waiting = 0, free_at = 0;
  for (int tick = 0; tick < kTicks; ++tick) {
    for (std::size_t s = 0; s < kPeriods.size(); ++s) {
      if (tick % kPeriods[s] != 0) continue;
      ++sent[s];
      if (!queue.push(s, tick)) ++waiting;
    }
    if (tick < free_at || waiting == 0) continue;
    const auto taken = queue.take();
    --waiting;
    ++served[taken->source];
    queue.done(taken->source);
    free_at = tick + kWork;
  }
  EXPECT_GE(served[3], sent[3] - 1);
  const double share = (double{kTicks} / kWork - served[3]) / 3;
  for (std::size_t s = 0; s < 3; ++s) EXPECT_NEAR(served[s], share, 0.05 * share) << "source " << s;
}

TEST(FrameQueue, OneInFlightOfASourceWithTheLatestPolicy) {
  FrameQueue<int> queue;
  const std::size_t latest = queue.add_source(1, 1);
  ASSERT_FALSE(queue.push(latest, 1));
  const auto first = queue.take();
  ASSERT_TRUE(first);
  ASSERT_FALSE(queue.push(latest, 2));
  EXPECT_EQ(queue.push(latest, 3), 2);
  // The second worker gets its frame only when the first one is done.
  auto second = std::async(std::launch::async, [&] { return queue.take()->item; });
  EXPECT_EQ(second.wait_for(20ms), std::future_status::timeout);
  queue.done(latest);
  EXPECT_EQ(second.get(), 3);
}

TEST(FrameQueue, SeveralInFlightOfASourceWithThePolicyAll) {
  FrameQueue<int> queue;
  const std::size_t all = queue.add_source(10, 3);
  for (int i = 0; i < 4; ++i) ASSERT_FALSE(queue.push(all, i));
  EXPECT_EQ(queue.take()->item, 0);
  EXPECT_EQ(queue.take()->item, 1);
  EXPECT_EQ(queue.take()->item, 2);
  auto fourth = std::async(std::launch::async, [&] { return queue.take()->item; });
  EXPECT_EQ(fourth.wait_for(20ms), std::future_status::timeout);
  queue.done(all);
  EXPECT_EQ(fourth.get(), 3);
}

TEST(FrameQueue, ClosedTakesNothingMoreAndHandsOutWhatWaits) {
  FrameQueue<int> queue;
  const std::size_t source = queue.add_source(4, 4);
  ASSERT_FALSE(queue.push(source, 1));
  queue.close();
  EXPECT_EQ(queue.push(source, 2), 2);
  EXPECT_EQ(queue.take()->item, 1);
  EXPECT_FALSE(queue.take());
}

TEST(FrameQueue, CloseWakesWaitingWorkers) {
  FrameQueue<int> queue;
  queue.add_source(1, 1);
  auto worker = std::async(std::launch::async, [&] { return queue.take().has_value(); });
  queue.close();
  EXPECT_FALSE(worker.get());
}

TEST(FrameQueue, TakesOtherLimitsWhileItWorks) {
  FrameQueue<int> queue;
  const std::size_t source = queue.add_source(4, 1);
  for (int i = 0; i < 4; ++i) ASSERT_FALSE(queue.push(source, i));
  ASSERT_EQ(queue.take()->item, 0);
  EXPECT_EQ(queue.configure(source, 2, 2), (std::vector<int>{1}));
  EXPECT_EQ(queue.take()->item, 2) << "two may be in flight now";
  EXPECT_EQ(queue.drop_oldest(source), 3);
  EXPECT_EQ(queue.drop_oldest(source), std::nullopt);
}

TEST(FrameQueue, ANewLimitWakesAWorker) {
  FrameQueue<int> queue;
  const std::size_t source = queue.add_source(4, 1);
  for (int i = 0; i < 2; ++i) ASSERT_FALSE(queue.push(source, i));
  ASSERT_TRUE(queue.take());
  auto second = std::async(std::launch::async, [&] { return queue.take()->item; });
  EXPECT_TRUE(queue.configure(source, 4, 2).empty());
  EXPECT_EQ(second.get(), 1);
}

TEST(FrameQueue, DropsWhatWaitsOldestFirst) {
  FrameQueue<int> queue;
  const std::size_t a = queue.add_source(4, 1);
  const std::size_t b = queue.add_source(4, 1);
  for (int i = 0; i < 3; ++i) ASSERT_FALSE(queue.push(a, i));
  ASSERT_FALSE(queue.push(b, 10));
  std::vector<int> dropped;
  for (const auto& taken : queue.drop_waiting()) dropped.push_back(taken.item);
  EXPECT_EQ(dropped, (std::vector<int>{0, 1, 2, 10}));
  EXPECT_TRUE(queue.wait_idle(0ms));
}

TEST(FrameQueue, IdleWhenNothingWaitsOrIsInFlight) {
  FrameQueue<int> queue;
  const std::size_t source = queue.add_source(1, 1);
  EXPECT_TRUE(queue.wait_idle(0ms));
  ASSERT_FALSE(queue.push(source, 1));
  EXPECT_FALSE(queue.wait_idle(1ms));
  ASSERT_TRUE(queue.take());
  EXPECT_FALSE(queue.wait_idle(1ms));
  std::thread worker([&] { queue.done(source); });
  EXPECT_TRUE(queue.wait_idle(60s));
  worker.join();
}

}  // namespace
}  // namespace graspd

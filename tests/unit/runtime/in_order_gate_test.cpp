// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/runtime/in_order_gate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <random>
#include <thread>
#include <vector>

namespace graspd {
namespace {

TEST(InOrderGate, AnyOrderOfReleaseComesOutInTicketOrder) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::vector<int> out;
    InOrderGate<int> gate([&](int result) { out.push_back(result); });
    std::vector<int> tickets(17);
    std::iota(tickets.begin(), tickets.end(), 0);
    for (const int expected : tickets) ASSERT_EQ(gate.take_ticket(), static_cast<std::uint64_t>(expected));
    std::vector<int> order = tickets;
    std::shuffle(order.begin(), order.end(), std::mt19937(seed));
    for (std::size_t i = 0; i < order.size(); ++i) {
      gate.release(static_cast<std::uint64_t>(order[i]), order[i]);
      // Nothing is held back longer than it must be.
      std::vector<int> released(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(i) + 1);
      std::sort(released.begin(), released.end());
      std::size_t expected = 0;
      while (expected < released.size() && released[expected] == static_cast<int>(expected)) ++expected;
      ASSERT_EQ(out.size(), expected) << "seed " << seed;
    }
    EXPECT_EQ(out, tickets);
  }
}

TEST(InOrderGate, TheFirstReleaseOfATicketCounts) {
  std::vector<int> out;
  InOrderGate<int> gate([&](int result) { out.push_back(result); });
  for (std::uint64_t expected = 0; expected < 3; ++expected) ASSERT_EQ(gate.take_ticket(), expected);
  gate.release(1, 10);
  EXPECT_EQ(gate.waiting(), 1u);
  gate.release(1, 11);
  gate.release(0, 0);
  gate.release(0, 1);
  gate.release(1, 12);
  gate.release(2, 20);
  EXPECT_EQ(gate.waiting(), 0u);
  EXPECT_EQ(out, (std::vector<int>{0, 10, 20}));
}

TEST(InOrderGate, WorkersAndDropsKeepTheOrder) {
  constexpr int kFrames = 4000;
  constexpr int kThreads = 4;
  std::vector<int> out;
  std::atomic<int> publishing{0};
  bool alone = true;
  InOrderGate<int> gate([&](int result) {
    alone = alone && publishing.fetch_add(1) == 0;
    out.push_back(result);
    publishing.fetch_sub(1);
  });
  // Each ticket is released once, by a thread and at a time that chance decides; every third as dropped
  // (negative).
  std::vector<std::vector<int>> shares(kThreads);
  std::mt19937 random(7);
  for (int i = 0; i < kFrames; ++i) {
    ASSERT_EQ(gate.take_ticket(), static_cast<std::uint64_t>(i));
    shares[random() % kThreads].push_back(i);
  }
  for (auto& share : shares) std::shuffle(share.begin(), share.end(), random);
  std::vector<std::thread> threads;
  for (const auto& share : shares) {
    threads.emplace_back([&gate, &share] {
      for (const int i : share) gate.release(static_cast<std::uint64_t>(i), i % 3 == 0 ? -i - 1 : i);
    });
  }
  for (std::thread& thread : threads) thread.join();
  ASSERT_EQ(out.size(), static_cast<std::size_t>(kFrames));
  EXPECT_TRUE(alone);
  for (int i = 0; i < kFrames; ++i) ASSERT_EQ(out[static_cast<std::size_t>(i)], i % 3 == 0 ? -i - 1 : i);
}

}  // namespace
}  // namespace graspd

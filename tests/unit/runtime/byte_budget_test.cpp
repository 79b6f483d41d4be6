// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/runtime/byte_budget.hpp"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace graspd {
namespace {

TEST(ByteBudget, GivesUpToTheLimitAndTakesBack) {
  ByteBudget budget;
  {
    auto first = budget.take(60, 100);
    ASSERT_TRUE(first);
    EXPECT_FALSE(budget.take(41, 100));
    EXPECT_EQ(budget.used(), 60);
    const auto second = budget.take(40, 100);
    ASSERT_TRUE(second);
    EXPECT_EQ(budget.used(), 100);
    const ByteBudget::Lease moved = std::move(*first);
    EXPECT_EQ(budget.used(), 100);
  }
  EXPECT_EQ(budget.used(), 0);
}

TEST(ByteBudget, ALeaseMayOutliveItsBudget) {
  std::optional<ByteBudget::Lease> lease;
  {
    ByteBudget budget;
    lease = budget.take(10, 100);
  }
  lease.reset();
}

TEST(ByteBudget, ManyThreadsNeverHoldMoreThanTheLimit) {
  ByteBudget budget;
  std::atomic<bool> too_much = false;
  std::atomic<std::int64_t> held = 0;
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&] {
      for (int i = 0; i < 5000; ++i) {
        const auto lease = budget.take(30, 100);
        if (!lease) continue;
        if ((held += 30) > 100) too_much = true;
        held -= 30;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_FALSE(too_much);
  EXPECT_EQ(budget.used(), 0);
}

}  // namespace
}  // namespace graspd

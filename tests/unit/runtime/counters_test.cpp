// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/runtime/counters.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <random>
#include <vector>

#include "tests/unit/runtime/manual_clock.hpp"

namespace graspd {
namespace {

using namespace std::chrono_literals;

TEST(LatencyWindow, EmptyIsZero) {
  EXPECT_EQ(LatencyWindow().percentile(0.99), 0);
}

TEST(LatencyWindow, NearestRank) {
  LatencyWindow window;
  for (const double value : {5.0, 1.0, 4.0, 2.0, 3.0}) window.add(value);
  EXPECT_EQ(window.percentile(0.5), 3);
  EXPECT_EQ(window.percentile(0.99), 5);
  EXPECT_EQ(window.percentile(0.2), 1);
  EXPECT_EQ(window.percentile(0.21), 2);
}

TEST(LatencyWindow, ForgetsAllButTheLast256) {
  std::mt19937 random(3);
  LatencyWindow window;
  std::vector<double> all;
  for (int i = 0; i < 1000; ++i) {
    all.push_back(static_cast<double>(random() % 1000));
    window.add(all.back());
    std::vector<double> last(
        all.end() - std::min<std::ptrdiff_t>(256, static_cast<std::ptrdiff_t>(all.size())), all.end());
    std::sort(last.begin(), last.end());
    ASSERT_EQ(window.percentile(0.5), last[(last.size() + 1) / 2 - 1]);
    ASSERT_EQ(window.percentile(1.0), last.back());
  }
}

TEST(RateMeter, EventsASecond) {
  ManualClock clock;
  RateMeter meter;
  EXPECT_EQ(meter.update(100, clock.now()), 0);
  clock.advance(1s);
  EXPECT_DOUBLE_EQ(meter.update(130, clock.now()), 30);
  clock.advance(500ms);
  EXPECT_DOUBLE_EQ(meter.update(140, clock.now()), 20);
  EXPECT_EQ(meter.update(150, clock.now()), 0);
}

TEST(SequenceGaps, CountsWhatIsLeftOut) {
  SequenceGaps gaps;
  for (const int seq : {7, 8, 9, 12, 13, 20}) gaps.add(seq);
  EXPECT_EQ(gaps.lost(), 2 + 6);
}

TEST(SequenceGaps, UnknownAndRepeatedNumbersAreNoLoss) {
  SequenceGaps gaps;
  for (const int seq : {-1, 5, -1, 5, 6}) gaps.add(seq);
  EXPECT_EQ(gaps.lost(), 0);
}

TEST(SequenceGaps, ANewStartIsNoLoss) {
  SequenceGaps gaps;
  for (const int seq : {100, 101, 0, 1, 3}) gaps.add(seq);
  EXPECT_EQ(gaps.lost(), 1);
}

TEST(SequenceGaps, HostileNumbersDoNotOverflow) {
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  SequenceGaps gaps;
  for (const std::int64_t seq :
       {std::int64_t{0}, kMost, std::int64_t{0}, kMost, std::numeric_limits<std::int64_t>::min()})
    gaps.add(seq);
  EXPECT_EQ(gaps.lost(), 0);
}

}  // namespace
}  // namespace graspd

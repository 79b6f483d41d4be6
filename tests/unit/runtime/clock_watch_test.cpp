// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/runtime/clock_watch.hpp"

#include <gtest/gtest.h>

#include "tests/unit/runtime/manual_clock.hpp"

namespace graspd {
namespace {

using namespace std::chrono_literals;

TEST(ClockWatch, KnowsHowLongAMessageHasWaited) {
  ManualClock clock;
  ClockWatch watch;
  EXPECT_FALSE(watch.look(clock));
  const std::int64_t stamped = clock.wall_utime();
  clock.advance(300ms);
  EXPECT_FALSE(watch.look(clock));
  EXPECT_EQ(watch.since(stamped, clock, 10s), 300ms);
  EXPECT_EQ(watch.since(stamped, clock, 200ms), 0ms) << "longer than can be";
  EXPECT_EQ(watch.since(clock.wall_utime() + 1, clock, 10s), 0ms) << "ahead";
}

class ClockJump : public testing::TestWithParam<std::chrono::microseconds> {};

TEST_P(ClockJump, IsNoticedAndWallTimesOfThenAreNotTrusted) {
  ManualClock clock;
  ClockWatch watch;
  EXPECT_FALSE(watch.look(clock));
  const std::int64_t stamped = clock.wall_utime();
  clock.advance(5ms);
  clock.set_wall(GetParam());
  EXPECT_EQ(watch.look(clock), GetParam().count());
  EXPECT_FALSE(watch.look(clock)) << "once";
  EXPECT_EQ(watch.since(stamped, clock, 10s), 0ms);
  clock.advance(ClockWatch::kDoubt);
  EXPECT_FALSE(watch.look(clock));
  const std::int64_t later = clock.wall_utime();
  clock.advance(7ms);
  EXPECT_EQ(watch.since(later, clock, 10s), 7ms);
}

INSTANTIATE_TEST_SUITE_P(BothWays, ClockJump,
                         testing::Values(std::chrono::microseconds(-3600s), std::chrono::microseconds(-21ms),
                                         std::chrono::microseconds(21ms), std::chrono::microseconds(5s)));

TEST(ClockWatch, SlewingIsNoJump) {
  ManualClock clock;
  ClockWatch watch;
  for (int i = 0; i < 1000; ++i) {
    clock.advance(50ms);
    clock.set_wall(25us);  // the most that adjtime does
    EXPECT_FALSE(watch.look(clock));
  }
}

}  // namespace
}  // namespace graspd

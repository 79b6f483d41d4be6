// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/runtime/load_control.hpp"

#include <gtest/gtest.h>

#include "tests/unit/runtime/manual_clock.hpp"

namespace graspd {
namespace {

using namespace std::chrono_literals;

const LoadLimits kLimits{true, 0.1, 0.05, 0.5, 10};

class LoadControlTest : public testing::Test {
 protected:
  LoadControlTest() { control_.set_limits(kLimits); }

  /// Frames 30 ms apart; whether the effort changed on the way.
  bool answer(int frames, double latency_s) {
    bool changed = false;
    for (int i = 0; i < frames; ++i) {
      clock_.advance(30ms);
      changed = control_.answered(latency_s, clock_.now()) || changed;
    }
    return changed;
  }
  bool drop(int frames) {
    bool changed = false;
    for (int i = 0; i < frames; ++i) changed = control_.dropped(clock_.now()) || changed;
    return changed;
  }

  ManualClock clock_;
  LoadControl control_;
};

TEST_F(LoadControlTest, OneSlowFrameIsNoReason) {
  answer(20, 0.02);
  EXPECT_FALSE(answer(1, 0.5));
  EXPECT_FALSE(control_.degraded());
}

TEST_F(LoadControlTest, DegradesWhenTheMeanIsTooHighAndRecoversAfterAWhile) {
  EXPECT_TRUE(answer(4, 0.15));
  EXPECT_TRUE(control_.degraded());
  EXPECT_FALSE(answer(100, 0.02)) << "held";
  clock_.advance(10s);
  EXPECT_TRUE(answer(8, 0.02));
  EXPECT_FALSE(control_.degraded());
}

TEST_F(LoadControlTest, StaysDegradedBetweenTheLevels) {
  answer(4, 0.15);
  clock_.advance(100s);
  EXPECT_FALSE(answer(50, 0.07));
  EXPECT_TRUE(control_.degraded());
}

TEST_F(LoadControlTest, DegradesWhenTooManyAreDropped) {
  for (int i = 0; i < 20; ++i) {
    EXPECT_FALSE(answer(1, 0.01));
    EXPECT_FALSE(drop(1)) << "half of them is not more than half";
  }
  EXPECT_TRUE(drop(16));
  EXPECT_TRUE(control_.degraded());
  clock_.advance(20s);
  for (int i = 0; i < 20; ++i) {
    answer(1, 0.01);
    drop(1);
  }
  EXPECT_TRUE(control_.degraded()) << "still half of them";
  EXPECT_TRUE(answer(16, 0.01));
  EXPECT_FALSE(control_.degraded());
}

TEST_F(LoadControlTest, WaitsLongerEachTimeItWasTooEarly) {
  double hold_s = kLimits.hold_s;
  answer(4, 0.15);
  for (int round = 0; round < 6; ++round) {
    ASSERT_TRUE(control_.degraded());
    clock_.advance(std::chrono::milliseconds(static_cast<int>(1e3 * hold_s) - 1000));
    ASSERT_FALSE(answer(10, 0.02)) << "round " << round;
    clock_.advance(1s);
    ASSERT_TRUE(answer(10, 0.02)) << "round " << round;
    ASSERT_TRUE(answer(8, 0.15)) << "too early";
    hold_s = std::min(2 * hold_s, LoadControl::kLongestHold * kLimits.hold_s);
  }
}

TEST_F(LoadControlTest, OffAndNewLimits) {
  LoadLimits off = kLimits;
  off.enabled = false;
  answer(4, 0.15);
  control_.set_limits(kLimits);
  EXPECT_TRUE(control_.degraded()) << "the same limits change nothing";
  control_.set_limits(off);
  EXPECT_FALSE(control_.degraded());
  EXPECT_FALSE(answer(100, 9));
}

}  // namespace
}  // namespace graspd

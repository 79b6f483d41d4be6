// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/daemon/work_watch.hpp"

#include <gtest/gtest.h>

#include "tests/unit/daemon/messages.hpp"
#include "tests/unit/runtime/manual_clock.hpp"

namespace graspd {
namespace {

using namespace std::chrono_literals;

class WorkWatchTest : public testing::Test {
 protected:
  Job job(int deadline_ms, const std::shared_ptr<Stream>& stream) {
    SourceConfig source;
    source.deadline_ms = deadline_ms;
    Job made{
        stream, std::make_shared<const FrameProcessor>(source, "CLOUD", DecodeLimits{}, clock_, 1), 0, {}};
    made.message.arrival = clock_.now();
    return made;
  }
  Job job(int deadline_ms) { return job(deadline_ms, stream_); }
  /// One look with a limit of a second.
  int look() {
    return watch_.look(
        clock_.now(), 1s, [this](const Job&) { ++late_; }, [this](const Job&) { ++stuck_; });
  }

  ManualClock clock_;
  WorkWatch watch_;
  std::shared_ptr<Stream> stream_ = std::make_shared<Stream>("CLOUD", 0, [](Stream&, Answer) {});
  int late_ = 0;
  int stuck_ = 0;
};

TEST_F(WorkWatchTest, AFrameInTimeIsLeftAlone) {
  const Job one = job(300);
  const WorkWatch::Entry entry(watch_, one, clock_.now());
  clock_.advance(300ms);
  EXPECT_EQ(look(), 0);
  EXPECT_EQ(late_ + stuck_, 0);
  EXPECT_FALSE(entry.cancelled());
}

TEST_F(WorkWatchTest, ALateFrameIsGivenUpOnce) {
  const Job one = job(300);
  const WorkWatch::Entry entry(watch_, one, clock_.now());
  clock_.advance(301ms);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(look(), 0);
  EXPECT_EQ(late_, 1);
  EXPECT_EQ(stuck_, 0);
  EXPECT_TRUE(entry.cancelled());
}

TEST_F(WorkWatchTest, AStuckFrameIsAnsweredOnceAndCountedAsLongAsItIs) {
  const Job one = job(0);
  {
    const WorkWatch::Entry entry(watch_, one, clock_.now());
    clock_.advance(1001ms);
    EXPECT_EQ(look(), 1);
    EXPECT_EQ(look(), 1);
    EXPECT_EQ(stuck_, 1);
    EXPECT_TRUE(entry.cancelled());
  }
  EXPECT_EQ(look(), 0) << "the worker is back";
}

TEST_F(WorkWatchTest, NoLimitMeansNone) {
  const Job one = job(0);
  const WorkWatch::Entry entry(watch_, one, clock_.now());
  clock_.advance(3600s);
  const auto never = [](const Job&) { FAIL(); };
  EXPECT_EQ(watch_.look(clock_.now(), 0s, never, never), 0);
}

TEST_F(WorkWatchTest, GivesUpTheFramesOfOneStream) {
  const auto other = std::make_shared<Stream>("OTHER", 1, [](Stream&, Answer) {});
  const Job one = job(0);
  const Job two = job(0, other);
  const WorkWatch::Entry first(watch_, one, clock_.now());
  const WorkWatch::Entry second(watch_, two, clock_.now());
  int given_up = 0;
  watch_.give_up(*other, [&](const Job& given) {
    ++given_up;
    EXPECT_EQ(given.stream, other);
  });
  EXPECT_EQ(given_up, 1);
  EXPECT_FALSE(first.cancelled());
  EXPECT_TRUE(second.cancelled());
}

TEST_F(WorkWatchTest, AllIsForThoseThatBeginLaterToo) {
  const Job one = job(0);
  const WorkWatch::Entry before(watch_, one, clock_.now());
  watch_.cancel_all();
  const WorkWatch::Entry after(watch_, one, clock_.now());
  EXPECT_TRUE(before.cancelled());
  EXPECT_TRUE(after.cancelled());
}

}  // namespace
}  // namespace graspd

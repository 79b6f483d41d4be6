// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/view/frame_matcher.hpp"

#include <gtest/gtest.h>

namespace graspd {
namespace {

constexpr std::int64_t kMs = 1000;

class FrameMatcherTest : public testing::Test {
 protected:
  void cloud(std::int64_t seq, std::int64_t now_ms, const std::string& channel = "A") {
    matcher_.add_cloud(channel, {100 * seq, seq, "camera"}, bytes_, now_ms * kMs);
  }
  void list(std::int64_t seq, std::int64_t now_ms, const std::string& channel = "A",
            std::int8_t status = handle_list_t::OK) {
    handle_list_t list;
    list.utime = 100 * seq;
    list.seq = seq;
    list.source_channel = channel;
    list.status = status;
    matcher_.add_list(list, now_ms * kMs);
  }
  void segmentation(std::int64_t seq, std::int64_t now_ms) {
    matcher_.add_segmentation("A", 100 * seq, seq, bytes_, now_ms * kMs);
  }
  std::vector<std::int64_t> given() {
    std::vector<std::int64_t> seqs;
    for (const MatchedFrame& frame : given_) seqs.push_back(frame.header.seq);
    return seqs;
  }
  using Seqs = std::vector<std::int64_t>;

  std::vector<MatchedFrame> given_;
  std::vector<std::byte> bytes_{100};
  FrameMatcher matcher_{[this](MatchedFrame frame) { given_.push_back(std::move(frame)); }};
};

TEST_F(FrameMatcherTest, GivesACloudWithItsList) {
  cloud(1, 0);
  cloud(2, 60);
  list(1, 80);
  ASSERT_EQ(given(), Seqs{1});
  EXPECT_EQ(given_[0].list->seq, 1);
  list(2, 140);
  EXPECT_EQ(given(), (Seqs{1, 2}));
}

TEST_F(FrameMatcherTest, NeverRunsBackwards) {
  cloud(1, 0);
  cloud(2, 60);
  list(2, 100);
  list(1, 110);
  EXPECT_EQ(given(), Seqs{2});
}

TEST_F(FrameMatcherTest, ShowsCloudsAloneWhileNobodyAnswers) {
  cloud(1, 1);
  matcher_.look(100 * kMs);
  EXPECT_EQ(given(), Seqs{}) << "an answer may come";
  cloud(2, 400);
  matcher_.look(600 * kMs);
  EXPECT_EQ(given(), Seqs{2});
  EXPECT_FALSE(given_[0].list);
  cloud(3, 700);
  list(3, 750);
  cloud(4, 800);
  matcher_.look(900 * kMs);
  EXPECT_EQ(given(), (Seqs{2, 3})) << "somebody answers: its answer is waited for";
  matcher_.look(4000 * kMs);
  EXPECT_EQ(given(), (Seqs{2, 3, 4})) << "and nobody any more";
}

TEST_F(FrameMatcherTest, WaitsForSegmentationsWhereTheyCome) {
  cloud(1, 1);
  list(1, 50);
  EXPECT_EQ(given(), Seqs{1}) << "none came so far";
  segmentation(1, 51);  // comes too late for the first
  cloud(2, 100);
  list(2, 150);
  EXPECT_EQ(given(), Seqs{1});
  segmentation(2, 152);
  ASSERT_EQ(given(), (Seqs{1, 2}));
  EXPECT_EQ(given_[1].segmentation.size(), 100u);
  cloud(3, 200);
  list(3, 250);
  matcher_.look(700 * kMs);
  EXPECT_EQ(given(), (Seqs{1, 2, 3})) << "but not for ever";
}

TEST_F(FrameMatcherTest, PassesOverWhatWasNotWorkedOnUnlessThereIsNothingElse) {
  cloud(1, 1);
  list(1, 50);
  cloud(2, 100);
  list(2, 110, "A", handle_list_t::OVERLOADED);
  matcher_.look(900 * kMs);
  EXPECT_EQ(given(), Seqs{1});
  cloud(3, 1000);
  list(3, 1050);
  EXPECT_EQ(given(), (Seqs{1, 3}));
  cloud(4, 3500);
  list(4, 3600, "A", handle_list_t::OVERLOADED);
  matcher_.look(3700 * kMs);
  EXPECT_EQ(given(), (Seqs{1, 3, 4}));
}

TEST_F(FrameMatcherTest, StaysSmallWhateverComes) {
  bytes_.resize(1 << 20);
  list(0, 1);
  for (int i = 1; i < 300; ++i)
    for (int channel = 0; channel < 100; ++channel) cloud(i, 10, "channel " + std::to_string(channel));
  matcher_.look(20 * kMs);
  list(299, 30, "channel 62");
  EXPECT_EQ(given(), Seqs{299});
  list(299, 30, "channel 99");
  EXPECT_EQ(given(), Seqs{299}) << "channels beyond the bound are ignored";
}

}  // namespace
}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/metrics.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace graspd {
namespace {

JudgedHandle handle(int object, bool valid, float score = 0.5f) {
  JudgedHandle judged;
  judged.object = object;
  judged.valid = valid;
  judged.failure = valid ? "" : "fingers";
  judged.handle.score = score;
  return judged;
}

TEST(Metrics, NothingGivesNoShares) {
  const Figures f = figures(std::span<const JudgedFrame>());
  EXPECT_EQ(f.frames, 0);
  EXPECT_FALSE(f.recall());
  EXPECT_FALSE(f.precision());
  EXPECT_FALSE(f.best_of_frame());
  EXPECT_FALSE(f.best_five());
  EXPECT_FALSE(f.recall_at(0));
  EXPECT_FALSE(f.handles_per_frame());
  EXPECT_FALSE(f.handles_per_object());
  EXPECT_TRUE(figures_by_category({}).empty());
  EXPECT_TRUE(figures_by_object({}).empty());
  EXPECT_TRUE(failure_counts({}).empty());
  EXPECT_FALSE(calibration({}).expected_error);
}

TEST(Metrics, AFrameWithoutObjectsHasPrecisionAlone) {
  const Figures f = figures({"empty table", "", {}, {handle(-1, false), handle(3, true)}});
  EXPECT_FALSE(f.recall());
  EXPECT_DOUBLE_EQ(*f.precision(), 0.5);
  EXPECT_DOUBLE_EQ(*f.best_of_frame(), 0);
}

TEST(Metrics, AFrameWithoutHandlesMissesItsObjectsAndItsBest) {
  const Figures f = figures({"missed", "", {2, 3}, {}});
  EXPECT_DOUBLE_EQ(*f.recall(), 0);
  EXPECT_FALSE(f.precision());
  EXPECT_DOUBLE_EQ(*f.best_of_frame(), 0);
  EXPECT_FALSE(f.best_five());
}

TEST(Metrics, RecallCountsObjectsOnceAndOnlyThoseThatCount) {
  const Figures f =
      figures({"a", "", {2, 3, 4, 5}, {handle(2, true), handle(2, true), handle(3, false), handle(9, true)}});
  EXPECT_DOUBLE_EQ(*f.recall(), 0.25);
  EXPECT_DOUBLE_EQ(*f.precision(), 0.75);
  EXPECT_EQ(f.handles_on_objects, 3);
  EXPECT_EQ(f.max_handles_per_object, 2);
  EXPECT_DOUBLE_EQ(*f.handles_per_object(), 0.75);
}

TEST(Metrics, AnObjectNamedTwiceCountsOnce) {
  EXPECT_EQ(figures({"a", "", {2, 2}, {handle(2, true)}}).objects, 1);
  EXPECT_EQ(object_outcomes({"a", "", {2, 2}, {}}).size(), 1u);
}

TEST(Metrics, RecallAtLooksAtTheBestHandlesOfEachObject) {
  // Object 2 is found by its first handle, which is the frame's fourth; object 3 by its third.
  const Figures f =
      figures({"a", "", {2, 3}, {handle(3, false), handle(3, false), handle(3, true), handle(2, true)}});
  EXPECT_DOUBLE_EQ(*f.recall_at(0), 0.5);  // 1
  EXPECT_DOUBLE_EQ(*f.recall_at(1), 0.5);  // 2
  EXPECT_DOUBLE_EQ(*f.recall_at(2), 1.0);  // 3
  EXPECT_DOUBLE_EQ(*f.recall_at(3), 1.0);  // 5
}

TEST(Metrics, BestFiveLooksAtNoMore) {
  JudgedFrame frame{"a", "", {2}, {}};
  for (int i = 0; i < 8; ++i) frame.handles.push_back(handle(2, i != 1 && i != 6));
  const Figures f = figures(frame);
  EXPECT_DOUBLE_EQ(*f.best_five(), 0.8);
  EXPECT_DOUBLE_EQ(*f.precision(), 0.75);
  EXPECT_DOUBLE_EQ(*f.best_of_frame(), 1);
  EXPECT_EQ(f.max_handles_per_frame, 8);
}

TEST(Metrics, FramesAddUp) {
  const std::vector<JudgedFrame> frames{
      {"a", "box", {2}, {handle(2, true)}}, {"b", "can", {2, 3}, {handle(3, false)}}, {"c", "box", {2}, {}}};
  const Figures all = figures(frames);
  EXPECT_DOUBLE_EQ(*all.recall(), 0.25);
  EXPECT_DOUBLE_EQ(*all.best_of_frame(), 1.0 / 3);
  const auto categories = figures_by_category(frames);
  ASSERT_EQ(categories.size(), 2u);
  EXPECT_EQ(categories[0].category, "box");
  EXPECT_DOUBLE_EQ(*categories[0].figures.recall(), 0.5);
  EXPECT_DOUBLE_EQ(*categories[1].figures.recall(), 0);
  EXPECT_EQ(categories[0].figures.objects + categories[1].figures.objects, all.objects);
}

TEST(Metrics, ObjectsOverTheFramesThatShowThem) {
  const std::vector<JudgedFrame> frames{{"a", "box", {2, 3}, {handle(2, true), handle(3, false)}},
                                        {"b", "box", {2}, {}},
                                        {"c", "can", {2}, {handle(2, true)}}};
  const auto objects = figures_by_object(frames);
  ASSERT_EQ(objects.size(), 3u);
  EXPECT_EQ(objects[0].category, "box");
  EXPECT_EQ(objects[0].object, 2);
  EXPECT_EQ(objects[0].frames, 2);
  EXPECT_EQ(objects[0].frames_found, 1);
  EXPECT_EQ(objects[1].object, 3);
  EXPECT_EQ(objects[1].frames_found, 0);
  EXPECT_EQ(objects[2].category, "can");
  EXPECT_EQ(objects[2].frames_found, 1);
}

TEST(Metrics, OutcomesSayTheRankOfTheFirstValidHandle) {
  const auto outcomes =
      object_outcomes({"a", "", {3, 2}, {handle(2, false), handle(3, false), handle(2, true)}});
  ASSERT_EQ(outcomes.size(), 2u);
  EXPECT_EQ(outcomes[0].object, 3);
  EXPECT_FALSE(outcomes[0].found());
  EXPECT_EQ(outcomes[0].best_valid_rank, -1);
  EXPECT_EQ(outcomes[1].handles, 2);
  EXPECT_EQ(outcomes[1].best_valid_rank, 2);
}

TEST(Metrics, FailuresMostFrequentFirst) {
  JudgedFrame frame{"a", "", {}, {handle(2, false), handle(2, false), handle(2, true), handle(2, false)}};
  frame.handles[1].failure = frame.handles[3].failure = "way";
  const auto counts = failure_counts(std::span(&frame, 1));
  ASSERT_EQ(counts.size(), 2u);
  EXPECT_EQ(counts[0].failure, "way");
  EXPECT_EQ(counts[0].handles, 2);
  EXPECT_EQ(counts[1].failure, "fingers");
}

TEST(Metrics, AScoreThatIsTheShareOfValidHandlesHasNoError) {
  JudgedFrame frame{"a", "", {}, {}};
  for (int i = 0; i < 4; ++i) frame.handles.push_back(handle(2, i < 3, 0.75f));
  frame.handles.push_back(handle(2, true, 1.0f));
  const Calibration exact = calibration(std::span(&frame, 1));
  EXPECT_DOUBLE_EQ(*exact.expected_error, 0);
  ASSERT_EQ(exact.bins.size(), 10u);
  EXPECT_EQ(exact.bins[7].handles, 4);
  EXPECT_EQ(exact.bins[7].valid_handles, 3);
  EXPECT_EQ(exact.bins[9].handles, 1);
}

TEST(Metrics, ScoresThatPromiseTooMuchCost) {
  JudgedFrame frame{"a", "", {}, {handle(2, false, 1), handle(2, true, 1), handle(2, true, 0)}};
  // Two handles at 1 of which half hold, one at 0 that holds.
  EXPECT_DOUBLE_EQ(*calibration(std::span(&frame, 1)).expected_error, 2.0 / 3);
}

TEST(Metrics, ScoresOutOfRangeStayInTheLastBins) {
  JudgedFrame frame{"a", "", {}, {handle(2, true, 7), handle(2, true, -7), handle(2, true, NAN)}};
  const Calibration c = calibration(std::span(&frame, 1));
  EXPECT_EQ(c.bins.back().handles, 1);
  EXPECT_EQ(c.bins.front().handles, 2);
}

}  // namespace
}  // namespace graspd

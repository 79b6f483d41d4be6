// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Which places of one object are kept: spread over it, the best of it always.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "service/pipeline/handle_ranking.hpp"

namespace graspd {
namespace {

/// Scores of these tests are spread over all there are.
HandleRankingConfig lenient() {
  HandleRankingConfig config;
  config.min_score = 0.01f;
  config.min_further_score = 0.5f;
  return config;
}

RankedHandle handle_at(float x, float score, int object = 0, int id = 0) {
  RankedHandle ranked;
  ranked.handle.position = {x, static_cast<float>(object), 0};
  ranked.handle.score = score;
  ranked.handle.segment = id;
  ranked.object = object;
  return ranked;
}

TEST(HandleRankingSpread, PlacesSpreadOverALongObject) {
  std::pmr::vector<RankedHandle> handles;
  for (int i = 0; i <= 60; ++i) handles.push_back(handle_at(0.005f * static_cast<float>(i), 0.95f));
  const HandleRankingConfig config;
  const std::pmr::vector<Handle> ranked = rank_handles(handles, config);
  ASSERT_EQ(static_cast<int>(ranked.size()), config.max_per_object);
  for (std::size_t a = 0; a < ranked.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      EXPECT_GT((ranked[a].position - ranked[b].position).norm(), config.spread_m);
}

TEST(HandleRankingSpread, APlaceElsewhereBeatsASlightlyBetterOneNextToTheBest) {
  HandleRankingConfig config = lenient();
  config.max_per_object = 2;
  const std::pmr::vector<RankedHandle> handles{handle_at(0, 0.9f), handle_at(0.025f, 0.89f),
                                               handle_at(0.2f, 0.8f)};
  const std::pmr::vector<Handle> far = rank_handles(handles, config);
  ASSERT_EQ(far.size(), 2u);
  EXPECT_EQ(far[0].score, 0.9f);
  EXPECT_EQ(far[1].score, 0.8f);
  config.spread_m = 0.002f;
  const std::pmr::vector<Handle> near = rank_handles(handles, config);
  ASSERT_EQ(near.size(), 2u);
  EXPECT_EQ(near[1].score, 0.89f) << "with a short spread the score decides";
}

TEST(HandleRankingSpread, APlaceElsewhereThatIsMuchWorseDoesNotWin) {
  HandleRankingConfig config = lenient();
  config.max_per_object = 2;
  config.min_further_score = 0;
  const std::pmr::vector<Handle> ranked =
      rank_handles({handle_at(0, 0.9f), handle_at(0.05f, 0.85f), handle_at(0.3f, 0.1f)}, config);
  ASSERT_EQ(ranked.size(), 2u);
  EXPECT_EQ(ranked[1].score, 0.85f);
}

TEST(HandleRankingSpread, FurtherHandlesMustBeBetterThanTheFirst) {
  HandleRankingConfig config = lenient();
  config.min_further_score = 0.5f;
  const auto num_kept = [&config](float best, float further) {
    return rank_handles({handle_at(0, best), handle_at(0.2f, further)}, config).size();
  };
  EXPECT_EQ(num_kept(0.9f, 0.49f), 1u);
  EXPECT_EQ(num_kept(0.9f, 0.5f), 2u) << "the limit belongs to it";
  EXPECT_EQ(num_kept(0.3f, 0.2f), 1u) << "the best of an object stays";
  config.min_further_score = 0;
  EXPECT_EQ(num_kept(0.3f, 0.2f), 2u);
}

TEST(HandleRankingSpread, TheBestOfEveryObjectStays) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(0, 1);
  HandleRankingConfig config = lenient();
  std::pmr::vector<RankedHandle> handles;
  std::map<int, float> best;
  for (int i = 0; i < 300; ++i) {
    const int object = i % 20;
    // Most objects have poor handles alone.
    const float score = config.min_score + (1 - config.min_score) * unit(random) * unit(random) / 2;
    handles.push_back(handle_at(0.3f * unit(random), score, object));
    best[object] = std::max(best[object], score);
  }
  std::map<int, float> kept;
  for (const Handle& handle : rank_handles(handles, config)) {
    float& most = kept[static_cast<int>(handle.position.y())];
    most = std::max(most, handle.score);
  }
  EXPECT_EQ(kept, best);
}

TEST(HandleRankingSpread, TiesStayInOrder) {
  HandleRankingConfig config = lenient();
  config.max_per_object = 1;
  const std::pmr::vector<Handle> one = rank_handles(
      {handle_at(0, 0.7f, 0, 10), handle_at(0.1f, 0.7f, 0, 11), handle_at(0.2f, 0.7f, 0, 12)}, config);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0].segment, 10);
  config.max_per_object = 3;
  // Both of the others are as far from the first.
  const std::pmr::vector<Handle> all = rank_handles(
      {handle_at(0, 0.7f, 0, 10), handle_at(0.1f, 0.7f, 0, 11), handle_at(-0.1f, 0.7f, 0, 12)}, config);
  ASSERT_EQ(all.size(), 3u);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(all[static_cast<std::size_t>(i)].segment, 10 + i);
}

TEST(HandleRankingSpread, NothingIsChosenTwice) {
  HandleRankingConfig config = lenient();
  config.distinct_distance_m = 0;
  config.max_per_object = 10;
  std::pmr::vector<RankedHandle> handles;
  for (int i = 0; i < 6; ++i) handles.push_back(handle_at(i < 3 ? 0.0f : 0.1f, 0.8f, i % 2, i));
  std::set<int> ids;
  const std::pmr::vector<Handle> ranked = rank_handles(handles, config);
  for (const Handle& handle : ranked) EXPECT_TRUE(ids.insert(handle.segment).second) << handle.segment;
  EXPECT_EQ(ranked.size(), handles.size());
}

TEST(HandleRankingSpread, APlaceIsTakenOnceByWhicheverObject) {
  RankedHandle same = handle_at(0, 0.6f, 1);
  same.handle.position.y() = 0;
  const std::pmr::vector<Handle> ranked = rank_handles({handle_at(0, 0.8f, 0), same}, {});
  ASSERT_EQ(ranked.size(), 1u);
  EXPECT_EQ(ranked[0].score, 0.8f);
}

}  // namespace
}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The handle that is marked as the first of its object leads it, whatever the others score.
#include <gtest/gtest.h>

#include <memory_resource>

#include <algorithm>

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

RankedHandle handle_at(float x, float score, int object = 0, bool is_first = false) {
  RankedHandle ranked;
  ranked.handle.position = {x, static_cast<float>(object), 0};
  ranked.handle.score = score;
  ranked.object = object;
  ranked.is_first = is_first;
  return ranked;
}

TEST(HandleRankingFirst, LeadsItsObjectAndTheOthersGetItsScore) {
  const std::pmr::vector<Handle> ranked =
      rank_handles({handle_at(0, 0.9f), handle_at(0.2f, 0.6f), handle_at(0.1f, 0.7f, 0, true)}, lenient());
  ASSERT_EQ(ranked.size(), 3u);
  EXPECT_EQ(ranked[0].position.x(), 0.1f);
  EXPECT_EQ(ranked[0].score, 0.7f);
  EXPECT_EQ(ranked[1].position.x(), 0.0f);
  EXPECT_EQ(ranked[1].score, 0.7f) << "what it scores beyond the first is noise";
  EXPECT_EQ(ranked[2].score, 0.6f);
}

TEST(HandleRankingFirst, TakesThePlaceOfABetterOneNextToIt) {
  const std::pmr::vector<Handle> ranked =
      rank_handles({handle_at(0, 0.9f), handle_at(0.01f, 0.7f, 0, true)}, {});
  ASSERT_EQ(ranked.size(), 1u);
  EXPECT_EQ(ranked[0].position.x(), 0.01f);
}

TEST(HandleRankingFirst, ObjectsAreInTheOrderOfTheirFirstHandles) {
  const std::pmr::vector<Handle> ranked =
      rank_handles({handle_at(0, 0.95f, 1), handle_at(0.2f, 0.6f, 1, true), handle_at(0, 0.8f, 2)}, {});
  ASSERT_EQ(ranked.size(), 3u);
  EXPECT_EQ(ranked[0].position.y(), 2.0f);
  EXPECT_EQ(ranked[1].position.x(), 0.2f);
  EXPECT_EQ(ranked[2].score, 0.6f);
}

TEST(HandleRankingFirst, AnAllButRefutedOneHasNoOthersBesideIt) {
  HandleRankingConfig config = lenient();
  const auto num_kept = [&config](float first) {
    return rank_handles({handle_at(0, 0.9f), handle_at(0.2f, first, 0, true)}, config).size();
  };
  EXPECT_EQ(num_kept(0.17f), 1u);
  EXPECT_EQ(num_kept(0.18f), 2u);
}

TEST(HandleRankingFirst, BelowTheLeastScoreItDoesNotCount) {
  HandleRankingConfig config = lenient();
  config.min_score = 0.3f;
  const std::pmr::vector<Handle> ranked =
      rank_handles({handle_at(0, 0.9f), handle_at(0.2f, 0.2f, 0, true)}, config);
  ASSERT_EQ(ranked.size(), 1u);
  EXPECT_EQ(ranked[0].score, 0.9f);
}

TEST(HandleRankingFirst, ItsScoreIsFinal) {
  std::pmr::vector<std::size_t> asked;
  const auto settle = [&asked](const std::pmr::vector<std::size_t>& which,
                               std::pmr::vector<RankedHandle>& handles) {
    asked.insert(asked.end(), which.begin(), which.end());
    for (const std::size_t i : which) handles[i].handle.score *= 0.5f;
  };
  HandleRankingConfig config = lenient();
  config.min_further_score = 0.1f;
  const std::pmr::vector<Handle> ranked =
      rank_handles({handle_at(0, 0.9f), handle_at(0.2f, 0.7f, 0, true)}, config, settle);
  EXPECT_EQ(asked, std::pmr::vector<std::size_t>{0});
  ASSERT_EQ(ranked.size(), 2u);
  EXPECT_EQ(ranked[0].score, 0.7f);
  EXPECT_EQ(ranked[1].score, 0.45f);
}

}  // namespace
}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/handle_ranking.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <random>

namespace graspd {
namespace {

RankedHandle handle_at(const Eigen::Vector3f& position, float score, int object = 0,
                       const Eigen::Matrix3f& rotation = Eigen::Matrix3f::Identity()) {
  RankedHandle ranked;
  ranked.handle.position = position;
  ranked.handle.rotation = rotation;
  ranked.handle.score = score;
  ranked.object = object;
  return ranked;
}

Eigen::Matrix3f turned(float angle_deg, const Eigen::Vector3f& axis) {
  return Eigen::AngleAxisf(angle_deg * std::numbers::pi_v<float> / 180, axis).toRotationMatrix();
}

HandleRankingConfig unlimited() {
  HandleRankingConfig config;
  config.max_handles = config.max_per_object = 1000;
  config.min_score = config.min_further_score = 0;
  return config;
}

TEST(HandleRanking, Nothing) {
  EXPECT_TRUE(rank_handles({}, {}).empty());
}

TEST(HandleRanking, BestFirstAndTiesInOrder) {
  std::pmr::vector<RankedHandle> handles;
  for (int i = 0; i < 30; ++i) {
    handles.push_back(handle_at({static_cast<float>(i), 0, 0}, 0.1f * static_cast<float>((7 * i) % 10), i));
    handles.back().handle.segment = i;
  }
  const std::pmr::vector<Handle> ranked = rank_handles(handles, unlimited());
  ASSERT_EQ(ranked.size(), 30u);
  for (std::size_t k = 1; k < ranked.size(); ++k) {
    EXPECT_GE(ranked[k - 1].score, ranked[k].score);
    if (ranked[k - 1].score == ranked[k].score) {
      EXPECT_LT(ranked[k - 1].segment, ranked[k].segment);
    }
  }
}

TEST(HandleRanking, OneHandleAPlace) {
  const auto count = [](const RankedHandle& other) {
    return rank_handles({handle_at({0, 0, 0}, 0.9f), other}, unlimited()).size();
  };
  EXPECT_EQ(count(handle_at({0, 0, 0}, 0.5f)), 1u);
  EXPECT_EQ(count(handle_at({0.019f, 0, 0}, 0.5f)), 1u);
  EXPECT_EQ(count(handle_at({0.021f, 0, 0}, 0.5f)), 2u);
  const Eigen::Vector3f axis = Eigen::Vector3f(1, 2, -1).normalized();
  EXPECT_EQ(count(handle_at({0.01f, 0, 0}, 0.5f, 0, turned(29, axis))), 1u);
  EXPECT_EQ(count(handle_at({0.01f, 0, 0}, 0.5f, 0, turned(31, axis))), 2u);
  EXPECT_EQ(count(handle_at({0.03f, 0, 0}, 0.5f, 0, turned(29, axis))), 2u);
}

TEST(HandleRanking, TheBestOfAPlaceStays) {
  const std::pmr::vector<Handle> ranked = rank_handles(
      {handle_at({0, 0, 0}, 0.2f), handle_at({0.01f, 0, 0}, 0.8f), handle_at({0.015f, 0, 0}, 0.5f)},
      unlimited());
  ASSERT_EQ(ranked.size(), 1u);
  EXPECT_EQ(ranked[0].score, 0.8f);
}

TEST(HandleRanking, HalfATurnAboutTheApproachIsTheSameGrip) {
  const auto count = [](const Eigen::Matrix3f& rotation) {
    return rank_handles({handle_at({0, 0, 0}, 0.9f), handle_at({0, 0, 0}, 0.5f, 0, rotation)}, unlimited())
        .size();
  };
  EXPECT_EQ(count(turned(180, Eigen::Vector3f::UnitZ())), 1u);
  EXPECT_EQ(count(turned(-170, Eigen::Vector3f::UnitZ())), 1u);
  EXPECT_EQ(count(turned(140, Eigen::Vector3f::UnitZ())), 2u);
  EXPECT_EQ(count(turned(90, Eigen::Vector3f::UnitZ())), 2u);
  EXPECT_EQ(count(turned(180, Eigen::Vector3f::UnitX())), 2u) << "from the other side is another grip";
  EXPECT_EQ(count(turned(180, Eigen::Vector3f::UnitY())), 2u);
}

TEST(HandleRanking, OfTwoPlacesTheOneNearerToTheMiddle) {
  HandleRankingConfig config = unlimited();
  config.max_per_object = 2;
  for (const float middle : {-0.1f, 0.1f}) {
    std::pmr::vector<RankedHandle> handles{handle_at({0, 0, 0}, 0.9f), handle_at({-0.1f, 0, 0}, 0.8f),
                                           handle_at({0.1f, 0, 0}, 0.8f)};
    handles[middle < 0 ? 2 : 1].central = 0.5f;
    const std::pmr::vector<Handle> ranked = rank_handles(handles, config);
    ASSERT_EQ(ranked.size(), 2u);
    EXPECT_EQ(ranked[1].position.x(), middle);
    EXPECT_EQ(ranked[1].score, 0.8f);
  }
}

TEST(HandleRanking, LimitsPerObjectAndInAll) {
  std::pmr::vector<RankedHandle> handles;
  for (int object = 0; object < 4; ++object)
    for (int i = 0; i < 5; ++i)
      handles.push_back(handle_at({static_cast<float>(object), static_cast<float>(i), 0},
                                  1 - 0.2f * static_cast<float>(object) - 0.01f * static_cast<float>(i),
                                  object));
  HandleRankingConfig config = unlimited();
  config.max_per_object = 2;
  std::map<int, int> per_object;
  for (const Handle& handle : rank_handles(handles, config))
    ++per_object[static_cast<int>(handle.position.x())];
  EXPECT_EQ(per_object, (std::map<int, int>{{0, 2}, {1, 2}, {2, 2}, {3, 2}}));
  config.max_handles = 3;
  const std::pmr::vector<Handle> three = rank_handles(handles, config);
  ASSERT_EQ(three.size(), 3u);
  // Whatever the order of the places, what stays are the best: nothing that was left out beats the first.
  EXPECT_EQ(three[0].score, 1);
}

TEST(HandleRanking, TheLeastScoreBelongsToTheList) {
  HandleRankingConfig config = unlimited();
  config.min_score = 0.5f;
  const std::pmr::vector<Handle> ranked = rank_handles(
      {handle_at({0, 0, 0}, 0.5f), handle_at({1, 0, 0}, 0.499f), handle_at({2, 0, 0}, 0.9f)}, config);
  ASSERT_EQ(ranked.size(), 2u);
  EXPECT_EQ(ranked[1].score, 0.5f);
}

TEST(HandleRanking, NoTwoOfALongListAreOnePlace) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> unit(0, 1);
  std::pmr::vector<RankedHandle> handles;
  for (int i = 0; i < 400; ++i) {
    const Eigen::Vector3f p(0.1f * unit(random), 0.1f * unit(random), 0.1f * unit(random));
    handles.push_back(handle_at(p, unit(random), 0, turned(360 * unit(random), Eigen::Vector3f::UnitZ())));
  }
  const std::pmr::vector<Handle> ranked = rank_handles(handles, unlimited());
  EXPECT_GT(ranked.size(), 20u);
  for (std::size_t a = 0; a < ranked.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      if ((ranked[a].position - ranked[b].position).norm() >= 0.02f) continue;
      // All turns are about z here: the angle between grips is that between their closing axes, modulo half a
      // turn.
      const float cosine = std::abs(ranked[a].rotation.col(1).dot(ranked[b].rotation.col(1)));
      EXPECT_LT(cosine, std::cos(29.9f * std::numbers::pi_v<float> / 180));
    }
}

}  // namespace
}  // namespace graspd

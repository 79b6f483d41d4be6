// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/normal_lines.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace graspd {
namespace {

constexpr float kScale = 0.004f;
const Eigen::Vector2f kCenter(0.31f, -0.12f);

/// Of an arc around the center: places and normals, the latter turned by normally distributed angles.
std::vector<NormalLine> arc(float from_rad, float to_rad, float radius_m, float turned_rad,
                            std::uint32_t seed) {
  constexpr int kLines = 100;
  std::mt19937 random(seed);
  std::normal_distribution<float> turn(0, turned_rad > 0 ? turned_rad : 1);
  std::vector<NormalLine> lines;
  for (int i = 0; i < kLines; ++i) {
    const float angle = from_rad + (to_rad - from_rad) * static_cast<float>(i) / kLines;
    const float normal = angle + (turned_rad > 0 ? turn(random) : 0);
    const Eigen::Vector2f way(std::cos(angle), std::sin(angle));
    lines.push_back({kCenter + radius_m * way, {std::cos(normal), std::sin(normal)}});
  }
  return lines;
}

TEST(NormalLines, PassesIsADistanceWithASide) {
  const NormalLine line{{1, 2}, {0, 1}};
  EXPECT_FLOAT_EQ(line.passes({1, 7}), 0);
  EXPECT_FLOAT_EQ(std::abs(line.passes({4, 0})), 3);
  EXPECT_FLOAT_EQ(line.passes({4, 0}), -line.passes({-2, 0}));
}

TEST(NormalLines, ThoseOfAnArcMeetInItsCenter) {
  for (const float to : {1.6f, 3.0f, 6.2f}) {
    const auto met = meeting_point(arc(0, to, 0.04f, 0, 1), kScale);
    ASSERT_TRUE(met);
    EXPECT_LT((*met - kCenter).norm(), 1e-4f);
  }
}

TEST(NormalLines, NormalsOfTheInsideMeetThereToo) {
  auto lines = arc(0, 3, 0.04f, 0, 1);
  for (std::size_t i = 0; i < lines.size(); i += 2) lines[i].normal *= -1;
  const auto met = meeting_point(lines, kScale);
  ASSERT_TRUE(met);
  EXPECT_LT((*met - kCenter).norm(), 1e-4f);
}

TEST(NormalLines, NoiseIsAveraged) {
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    const auto met = meeting_point(arc(0, 3, 0.04f, 0.17f, seed), kScale);
    ASSERT_TRUE(met);
    EXPECT_LT((*met - kCenter).norm(), 0.004f) << "lines pass it by 7 mm";
  }
}

TEST(NormalLines, AFewOfSomethingElseMoveItLittle) {
  auto lines = arc(0, 3, 0.04f, 0, 1);
  for (std::size_t i = 0; i < lines.size(); i += 5) lines[i].p += Eigen::Vector2f(0.03f, 0.02f);
  const auto met = meeting_point(lines, kScale);
  ASSERT_TRUE(met);
  EXPECT_LT((*met - kCenter).norm(), 0.002f);
}

TEST(NormalLines, ParallelOnesMeetNowhere) {
  EXPECT_FALSE(meeting_point(arc(1, 1.1f, 0.04f, 0, 1), kScale));
  EXPECT_FALSE(meeting_point({}, kScale));
}

}  // namespace
}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/union_find.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <vector>

namespace graspd {
namespace {

TEST(UnionFind, SingletonsAreTheirOwnRepresentatives) {
  UnionFind sets(5);
  for (std::uint32_t i = 0; i < 5; ++i) EXPECT_EQ(sets.find(i), i);
}

TEST(UnionFind, RepresentativeIsTheSmallestWhateverTheOrder) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> unions{{7, 3}, {9, 7}, {3, 5}, {1, 2}, {8, 8}};
  std::mt19937 random(1);
  for (int round = 0; round < 20; ++round) {
    std::shuffle(unions.begin(), unions.end(), random);
    UnionFind sets(10);
    for (const auto& [a, b] : unions) sets.unite(a, b);
    for (const std::uint32_t i : {3u, 5u, 7u, 9u}) EXPECT_EQ(sets.find(i), 3u);
    for (const std::uint32_t i : {1u, 2u}) EXPECT_EQ(sets.find(i), 1u);
    for (const std::uint32_t i : {0u, 4u, 6u, 8u}) EXPECT_EQ(sets.find(i), i);
  }
}

TEST(UnionFind, FlattenedParentsAreRepresentatives) {
  UnionFind sets(100);
  for (std::uint32_t i = 99; i >= 10; --i) sets.unite(i, i - 10);  // ten chains of ten
  std::vector<std::uint32_t> all(100);
  std::iota(all.begin(), all.end(), 0u);
  sets.flatten(all);
  for (std::uint32_t i = 0; i < 100; ++i) EXPECT_EQ(sets.parents()[i], i % 10);
}

}  // namespace
}  // namespace graspd

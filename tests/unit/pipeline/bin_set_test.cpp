// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Sets of bins against plain arrays of flags.
#include "service/pipeline/bin_set.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace graspd {
namespace {

using Flags = std::vector<std::uint8_t>;

Flags random_flags(std::size_t size, double share, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::bernoulli_distribution is_set(share);
  Flags flags(size);
  for (std::uint8_t& flag : flags) flag = is_set(random) ? 1 : 0;
  return flags;
}

std::vector<Flags> samples() {
  std::vector<Flags> samples{Flags(64, 0), Flags(64, 1), Flags(2048, 0), Flags(2048, 1)};
  std::uint32_t seed = 0;
  for (const std::size_t size : {64, 128, 192, 320, 2048})
    for (const double share : {0.02, 0.2, 0.5, 0.9}) samples.push_back(random_flags(size, share, ++seed));
  return samples;
}

TEST(BinSet, HoldsTheBins) {
  for (const Flags& flags : samples()) {
    const BinSet set(flags);
    ASSERT_EQ(set.size(), static_cast<int>(flags.size()));
    for (int bin = 0; bin < set.size(); ++bin)
      EXPECT_EQ(set.has(bin), flags[static_cast<std::size_t>(bin)] != 0) << bin;
    EXPECT_FALSE(set.has(-1));
    EXPECT_FALSE(set.has(set.size()));
  }
}

TEST(BinSet, FindsTheNextAndThePrevious) {
  for (const Flags& flags : samples()) {
    const BinSet set(flags);
    const int size = set.size();
    for (int bin = -2; bin < size + 2; ++bin) {
      int next = std::max(bin, 0), previous = std::min(bin, size - 1);
      while (next < size && !flags[static_cast<std::size_t>(next)]) ++next;
      while (previous >= 0 && !flags[static_cast<std::size_t>(previous)]) --previous;
      EXPECT_EQ(set.next(bin), std::min(next, size)) << bin;
      EXPECT_EQ(set.previous(bin), std::max(previous, -1)) << bin;
    }
  }
}

TEST(BinSet, CountsAndUnites) {
  const Flags a = random_flags(192, 0.3, 101), b = random_flags(192, 0.3, 102);
  const BinSet both = BinSet(a) | BinSet(b);
  int n = 0;
  for (int bin = 0; bin < 192; ++bin) {
    const auto k = static_cast<std::size_t>(bin);
    EXPECT_EQ(both.has(bin), a[k] != 0 || b[k] != 0);
    if (bin >= 10 && bin <= 150) n += a[k];
  }
  EXPECT_EQ(BinSet(a).count(10, 150), n);
  EXPECT_EQ(BinSet(a).count(150, 10), 0);
}

TEST(BinSet, FindsGapsOfAnyLength) {
  for (const Flags& flags : samples()) {
    const BinSet set(flags);
    for (const int length : {1, 2, 3, 5, 8, 12, 63, 64, 65, 200}) {
      const BinSet gaps = set.gaps(length);
      for (int bin = 0; bin < set.size(); ++bin) {
        bool is_gap = true;
        for (int k = bin; k < bin + length && k < set.size(); ++k)
          is_gap = is_gap && !flags[static_cast<std::size_t>(k)];
        ASSERT_EQ(gaps.has(bin), is_gap) << "length " << length << " bin " << bin;
      }
    }
  }
}

}  // namespace
}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/nth_value.hpp"

#include <gtest/gtest.h>

#include <memory_resource>
#include <random>
#include <vector>

namespace graspd {
namespace {

TEST(NthValue, IsWhatSortingGives) {
  std::mt19937 random(1);
  for (const std::size_t size : {1, 2, 15, 16, 17, 40, 333}) {
    for (const int levels : {3, 1000000}) {  // with many equal values, and hardly any
      std::pmr::vector<float> values(size);
      for (float& value : values) value = static_cast<float>(random() % static_cast<unsigned>(levels));
      std::pmr::vector<float> sorted = values;
      std::sort(sorted.begin(), sorted.end());
      for (std::size_t n = 0; n < size; ++n) {
        std::pmr::vector<float> least = values, most = values;
        EXPECT_EQ(nth_value(std::span<float>(least), n), sorted[n]) << size << " " << n;
        EXPECT_EQ(nth_value(std::span<float>(most), n, std::greater<>()), sorted[size - 1 - n]);
      }
    }
  }
}

}  // namespace
}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/refusal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace graspd {
namespace {

TEST(Refusal, ReasonsHaveDifferentLowerSnakeNames) {
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < kNumRefusalReasons; ++i) {
    const std::string_view text = name(static_cast<RefusalReason>(i));
    EXPECT_TRUE(names.insert(text).second) << text;
    EXPECT_TRUE(
        std::all_of(text.begin(), text.end(), [](char c) { return c == '_' || (c >= 'a' && c <= 'z'); }));
  }
  EXPECT_FALSE(names.contains(name(static_cast<RefusalReason>(kNumRefusalReasons))));
}

}  // namespace
}  // namespace graspd

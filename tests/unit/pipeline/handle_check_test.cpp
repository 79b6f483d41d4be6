// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/handle_check.hpp"

#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <string>

namespace graspd {
namespace {

TEST(Failure, NamesAreDistinctAndLowerSnake) {
  std::set<std::string> names;
  for (std::size_t i = 0; i <= kNumFailures; ++i) {
    const std::string text(name(static_cast<Failure>(i)));
    EXPECT_TRUE(std::regex_match(text, std::regex("[a-z]+(_[a-z]+)*"))) << text;
    EXPECT_TRUE(names.insert(text).second) << text;
  }
  EXPECT_EQ(name(Failure::kTooWide), "too_wide");
  EXPECT_EQ(name(Failure::kNone), "none");
}

}  // namespace
}  // namespace graspd

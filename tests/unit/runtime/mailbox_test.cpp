// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/runtime/mailbox.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <vector>

namespace graspd {
namespace {

TEST(Mailbox, EmptyHasNothing) {
  Mailbox<int> mailbox(3);
  EXPECT_TRUE(mailbox.empty());
  EXPECT_EQ(mailbox.pop(), std::nullopt);
}

TEST(Mailbox, ASmallerOneReturnsWhatDoesNotFit) {
  Mailbox<int> mailbox(4);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(mailbox.push(i), std::nullopt);
  EXPECT_EQ(mailbox.set_capacity(2), (std::vector<int>{0, 1}));
  EXPECT_EQ(mailbox.push(4), 2);
  EXPECT_TRUE(mailbox.set_capacity(9).empty());
  EXPECT_EQ(mailbox.push(5), std::nullopt);
  EXPECT_EQ(mailbox.set_capacity(0).size(), 2u) << "one at least stays";
}

TEST(Mailbox, FullReturnsItsOldest) {
  Mailbox<int> mailbox(2);
  EXPECT_EQ(mailbox.push(1), std::nullopt);
  EXPECT_EQ(mailbox.push(2), std::nullopt);
  EXPECT_EQ(mailbox.push(3), 1);
  EXPECT_EQ(mailbox.push(4), 2);
  EXPECT_EQ(mailbox.size(), 2u);
  EXPECT_EQ(mailbox.pop(), 3);
  EXPECT_EQ(mailbox.pop(), 4);
  EXPECT_EQ(mailbox.pop(), std::nullopt);
}

TEST(Mailbox, HoldsOneAtLeast) {
  Mailbox<int> mailbox(0);
  EXPECT_EQ(mailbox.push(1), std::nullopt);
  EXPECT_EQ(mailbox.push(2), 1);
  EXPECT_EQ(mailbox.pop(), 2);
}

TEST(Mailbox, MovesItems) {
  Mailbox<std::unique_ptr<int>> mailbox(1);
  EXPECT_FALSE(mailbox.push(std::make_unique<int>(1)).has_value());
  const auto dropped = mailbox.push(std::make_unique<int>(2));
  ASSERT_TRUE(dropped.has_value());
  EXPECT_EQ(**dropped, 1);
  EXPECT_EQ(**mailbox.pop(), 2);
}

}  // namespace
}  // namespace graspd

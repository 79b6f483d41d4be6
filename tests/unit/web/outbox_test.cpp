// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/web/outbox.hpp"

#include <gtest/gtest.h>

namespace graspd {
namespace {

std::string take(Outbox& outbox) {
  const auto message = outbox.take();
  return message ? *message->bytes : "nothing";
}

TEST(Outbox, KeepsTheNewestOfATopicInItsPlace) {
  Outbox outbox(100);
  EXPECT_FALSE(outbox.put_latest(1, binary_message("cloud 1")));
  EXPECT_FALSE(outbox.put_latest(2, binary_message("handles 1")));
  EXPECT_TRUE(outbox.put_latest(1, binary_message("cloud 2")));
  EXPECT_EQ(outbox.size(), 2u);
  EXPECT_EQ(take(outbox), "cloud 2");
  // However often the other topic changes, this one has its turn.
  EXPECT_FALSE(outbox.put_latest(1, binary_message("cloud 3")));
  EXPECT_EQ(take(outbox), "handles 1");
  EXPECT_EQ(take(outbox), "cloud 3");
  EXPECT_EQ(take(outbox), "nothing");
}

TEST(Outbox, WhatMustNotBeLostComesInOrderUpToItsBound) {
  Outbox outbox(10);
  EXPECT_TRUE(outbox.put(text_message("12345")));
  EXPECT_TRUE(outbox.put(text_message("67890")));
  EXPECT_FALSE(outbox.put(text_message("x")));
  EXPECT_FALSE(outbox.put_latest(1, binary_message("a topic needs no room of theirs")));
  EXPECT_EQ(take(outbox), "12345");
  EXPECT_TRUE(outbox.put(text_message("x")));
  EXPECT_EQ(take(outbox), "67890");
}

TEST(Outbox, StaysSmallWhateverComes) {
  Outbox outbox(1000);
  for (int i = 0; i < 100'000; ++i) {
    (void)outbox.put_latest(i % 3, binary_message("frame"));
    (void)outbox.put(text_message("0123456789"));
  }
  EXPECT_EQ(outbox.size(), 103u);
}

}  // namespace
}  // namespace graspd

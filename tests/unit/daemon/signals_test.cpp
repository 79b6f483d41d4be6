// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/daemon/signals.hpp"

#include <gtest/gtest.h>

#include <csignal>

namespace graspd {
namespace {

TEST(Signals, AreAskedForInsteadOfEndingTheProcess) {
  const Signals signals;
  EXPECT_EQ(signals.received(), "");
  ASSERT_EQ(raise(SIGTERM), 0);
  EXPECT_EQ(signals.received(), "SIGTERM");
  EXPECT_EQ(signals.received(), "");
  ASSERT_EQ(raise(SIGINT), 0);
  EXPECT_EQ(signals.received(), "SIGINT");
  ASSERT_EQ(raise(SIGHUP), 0);
  EXPECT_EQ(signals.received(), "SIGHUP");
  ASSERT_EQ(raise(SIGPIPE), 0);
  EXPECT_EQ(signals.received(), "");
}

}  // namespace
}  // namespace graspd

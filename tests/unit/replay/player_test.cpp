// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/replay/player.hpp"

#include <gtest/gtest.h>

#include "tests/support/temp_folder.hpp"

namespace graspd {
namespace {

using Seconds = std::chrono::duration<double>;

/// Ten events, one a second, on channels A and B in turn.
std::vector<LogPart> ten_seconds(const TempFolder& folder) {
  EventLogFile log(folder / "log", EventLogFile::Existing::kRefuse);
  for (int i = 0; i < 10; ++i) log.write(1'000'000'000 + 1'000'000 * i, i % 2 == 0 ? "A" : "B", {});
  return {{folder / "log"}};
}

Player::TimePoint at(double seconds) {
  return Player::TimePoint() + std::chrono::duration_cast<Player::TimePoint::duration>(Seconds(seconds));
}

double due_s(const Player& player) {
  return Seconds(player.due().value() - at(0)).count();
}

TEST(Player, EventsAreDueInTheirRhythm) {
  const TempFolder folder;
  Player player(ten_seconds(folder), ".*", 2, at(0));
  for (int i = 0; i < 10; ++i) {
    EXPECT_NEAR(due_s(player), 0.5 * i, 1e-6);
    EXPECT_EQ(player.take().recv_utime, 1'000'000'000 + 1'000'000 * i);
  }
  EXPECT_TRUE(player.ended());
  EXPECT_FALSE(player.due());
}

TEST(Player, OtherChannelsArePassedOver) {
  const TempFolder folder;
  Player player(ten_seconds(folder), "B", 1, at(0));
  EXPECT_NEAR(due_s(player), 1, 1e-6);
  EXPECT_EQ(player.take().channel, "B");
  EXPECT_NEAR(due_s(player), 3, 1e-6);
}

TEST(Player, PausesAndGoesOnWhereItWas) {
  const TempFolder folder;
  Player player(ten_seconds(folder), ".*", 1, at(0));
  (void)player.take();
  EXPECT_TRUE(player.obey("pause", at(0.4)));
  EXPECT_FALSE(player.due());
  EXPECT_NEAR(player.position_s(at(50)), 0.4, 1e-9);
  EXPECT_TRUE(player.obey("toggle", at(100)));
  EXPECT_NEAR(due_s(player), 100.6, 1e-6);
  EXPECT_TRUE(player.obey("speed 0.5", at(100.2)));
  EXPECT_NEAR(due_s(player), 100.2 + 0.8, 1e-6);
}

TEST(Player, SeeksBothWaysAndAfterTheEnd) {
  const TempFolder folder;
  Player player(ten_seconds(folder), ".*", 1, at(0));
  EXPECT_TRUE(player.obey("seek 7.5", at(1)));
  EXPECT_NEAR(due_s(player), 1.5, 1e-6);
  EXPECT_EQ(player.take().recv_utime, 1'008'000'000);
  EXPECT_TRUE(player.obey("skip -3", at(1)));
  EXPECT_EQ(player.take().recv_utime, 1'005'000'000);
  EXPECT_TRUE(player.obey("seek 100", at(2)));
  EXPECT_TRUE(player.ended());
  EXPECT_TRUE(player.obey("skip -1000", at(2)));
  EXPECT_EQ(player.take().recv_utime, 1'000'000'000);
}

TEST(Player, WhatIsNoCommandChangesNothing) {
  const TempFolder folder;
  Player player(ten_seconds(folder), ".*", 1, at(0));
  for (const char* text :
       {"", "fly", "seek", "seek soon", "speed", "speed 0", "speed -1", "speed nan", "seek 1e300"})
    EXPECT_FALSE(player.obey(text, at(1))) << text;
  EXPECT_NEAR(due_s(player), 0, 1e-9);
}

TEST(Player, AnEmptyLogIsAtItsEnd) {
  const TempFolder folder;
  write_bytes(folder / "log", "");
  Player player({{folder / "log"}}, ".*", 1, at(0));
  EXPECT_TRUE(player.ended());
  EXPECT_TRUE(player.obey("seek 5", at(1)));
}

}  // namespace
}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/view/commands.hpp"

#include <gtest/gtest.h>

#include <random>

namespace graspd {
namespace {

TEST(ParseCommand, TakesWhatThePageSends) {
  EXPECT_EQ(std::get<AckCommand>(*parse_command(R"({"type":"ack","serial":12})")).serial, 12);
  EXPECT_EQ(std::get<FlowCommand>(*parse_command(R"({"type":"step"})")), FlowCommand::kStep);
  EXPECT_EQ(std::get<SourceCommand>(*parse_command(R"({"type":"source","channel":"A#b.C"})")).channel,
            "A#b.C");
  const auto set =
      std::get<SetCommand>(*parse_command(R"({"type":"set","source":"camera","theta_low_deg":6.5})"));
  EXPECT_EQ(set.source, "camera");
  EXPECT_EQ(set.theta_low_deg, 6.5);
  EXPECT_FALSE(set.theta_high_deg);
  const auto player =
      std::get<PlayerCommand>(*parse_command(R"({"type":"player","seek_us":5000000,"playing":false})"));
  EXPECT_EQ(player.seek_us, 5'000'000);
  EXPECT_EQ(player.playing, false);
}

TEST(ParseCommand, RefusesEverythingElse) {
  for (const char* text : {"",
                           "{",
                           "[]",
                           "null",
                           "1",
                           "\"pause\"",
                           R"({})",
                           R"({"type":1})",
                           R"({"type":"no such"})",
                           R"({"type":"pause","more":1})",
                           R"({"type":"ack","serial":-1})",
                           R"({"type":"ack","serial":1.5})",
                           R"({"type":"ack","serial":1e300})",
                           R"({"type":"ack","serial":"1"})",
                           R"({"type":"set","source":"camera","theta_low_deg":91})",
                           R"({"type":"set","source":"camera","theta_low_deg":-1})",
                           R"({"type":"set","source":"camera","leaf_size_m":0})",
                           R"({"type":"set","source":"camera","gripper":"a\u0000b"})",
                           R"({"type":"set","source":"camera","gripper":"a\nlcm: {}"})",
                           R"({"type":"set","source":"camera","yaml":"lcm: {}"})",
                           R"({"type":"player","speed":1e9})",
                           R"({"type":"player","playing":1})",
                           R"({"type":"source","channel":7})",
                           "{\"type\":\"pause\"}x",
                           "\xff\xfe"})
    EXPECT_FALSE(parse_command(text)) << text;
  EXPECT_FALSE(parse_command(R"({"type":"source","channel":")" + std::string(300, 'x') + "\"}"));
}

TEST(ParseCommand, OutlivesDepthAndNoise) {
  EXPECT_FALSE(parse_command(std::string(60'000, '[')));
  EXPECT_FALSE(parse_command(std::string(30'000, '[') + std::string(30'000, ']')));
  std::mt19937 random(1);
  const std::string good = R"({"type":"set","source":"camera","theta_low_deg":6.5,"gripper":"paper_80mm"})";
  for (int i = 0; i < 20'000; ++i) {
    std::string text = good;
    for (int k = 0; k < 3; ++k) text[random() % text.size()] = static_cast<char>(random());
    (void)parse_command(text);
  }
}

TEST(NeedsToken, EverythingThatOthersSee) {
  EXPECT_FALSE(needs_token(AckCommand{}));
  EXPECT_FALSE(needs_token(FlowCommand::kPause));
  EXPECT_FALSE(needs_token(SourceCommand{}));
  EXPECT_TRUE(needs_token(SetCommand{}));
  EXPECT_TRUE(needs_token(ConfigCommand::kUndo));
  EXPECT_TRUE(needs_token(PlayerCommand{}));
}

}  // namespace
}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/bridge/bridge_message.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "service/transport/message_parts.hpp"

namespace graspd {
namespace {

std::optional<control_t> parsed(const std::string& text) {
  std::string why;
  auto control = parse_control(text, why);
  EXPECT_NE(control.has_value(), !why.empty()) << text;
  return control;
}

TEST(BridgeMessage, Commands) {
  EXPECT_EQ(parsed(R"({"type":"control","command":"reload"})")->command, std::int8_t{control_t::RELOAD});
  EXPECT_EQ(parsed(R"({"type":"control","command":"undo"})")->command, std::int8_t{control_t::UNDO});
  EXPECT_EQ(parsed(R"({"type":"control","command":"reset"})")->command, std::int8_t{control_t::RESET});
  const auto set = parsed(R"({"text":"a: \"b\"\nc: 1","command":"set","type":"control"})");
  ASSERT_TRUE(set);
  EXPECT_EQ(set->command, std::int8_t{control_t::SET});
  EXPECT_EQ(set->text, "a: \"b\"\nc: 1");
}

TEST(BridgeMessage, WhatIsNoCommandIsRefused) {
  for (const char* text :
       {"", "{", "null", "7", "[]", "{}", R"({"type":"control"})", R"({"type":"ctrl","command":"undo"})",
        R"({"type":7,"command":"undo"})", R"({"type":"control","command":7})",
        R"({"type":"control","command":"format"})", R"({"type":"control","command":"set"})",
        R"({"type":"control","command":"set","text":7})", R"({"type":"control","command":"undo","text":""})",
        R"({"type":"control","command":"undo","more":1})",
        R"({"type":"control","command":"set","text":"a","id":1})",
        R"({"type":"control","command":"set","text":"a\u0000b"})",
        "{\"type\":\"control\",\"command\":\"\xff\"}"})
    EXPECT_FALSE(parsed(text)) << text;
}

TEST(BridgeMessage, DeepNestingIsRefused) {
  EXPECT_FALSE(parsed(std::string(60'000, '[')));
  EXPECT_FALSE(parsed("{\"type\":" + std::string(30'000, '[') + std::string(30'000, ']') + "}"));
}

TEST(BridgeMessage, TextAsLongAsTheWireTakes) {
  const auto with_text = [](int length) {
    return R"({"type":"control","command":"set","text":")" +
           std::string(static_cast<std::size_t>(length), 'a') + "\"}";
  };
  EXPECT_TRUE(parsed(with_text(kMaxOverridesLength)));
  EXPECT_FALSE(parsed(with_text(kMaxOverridesLength + 1)));
}

TEST(BridgeMessage, Texts) {
  EXPECT_EQ(envelope("status", "A\"B", R"({"a":1})"),
            R"({"type":"status","channel":"A\"B","message":{"a":1}})");
  EXPECT_EQ(sent_text(7), R"({"type":"sent","id":7})");
  EXPECT_EQ(refused_text("no"), R"({"type":"refused","why":"no"})");
  EXPECT_EQ(hello_text(true), R"({"type":"hello","version":")" GRASPD_VERSION R"(","may_write":true})");
}

}  // namespace
}  // namespace graspd

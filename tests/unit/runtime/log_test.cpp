// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/runtime/log.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include "tests/unit/runtime/manual_clock.hpp"

namespace graspd {
namespace {

using namespace std::chrono_literals;

TEST(Log, FieldsOnOneLine) {
  EXPECT_EQ(
      format_fields("started", {{"version", "0.1.0"}, {"workers", 2}, {"bytes", std::int64_t{1} << 40}}),
      "event=started version=0.1.0 workers=2 bytes=1099511627776");
}

TEST(Log, QuotesWhatWouldBreakTheLine) {
  EXPECT_EQ(
      format_fields(
          "e", {{"a", ""}, {"b", "two words"}, {"c", "x=\"y\\\""}, {"d", "first\nevent=forged\r\x1b[2J"}}),
      "event=e a=\"\" b=\"two words\" c=\"x=\\\"y\\\\\\\"\" d=\"first event=forged  [2J\"");
}

TEST(Log, HoldsBackWhatComesTooOften) {
  ManualClock clock;
  std::vector<std::string> lines;
  Log log(clock, [&](const std::string& line) { lines.push_back(line); });
  for (int i = 0; i < 1000; ++i) log.warning("frame_refused", {{"number", i}});
  log.info("other");
  ASSERT_EQ(lines.size(), static_cast<std::size_t>(Log::kLinesAPeriod) + 1);
  EXPECT_EQ(lines.back(), "event=other");
  clock.advance(Log::kPeriod);
  log.warning("frame_refused", {{"number", 1000}});
  EXPECT_EQ(lines.back(), "event=frame_refused number=1000 suppressed=990");
  log.warning("frame_refused", {{"number", 1001}});
  EXPECT_EQ(lines.back(), "event=frame_refused number=1001");
}

TEST(Log, ManyThreads) {
  ManualClock clock;
  int lines = 0;
  Log log(clock, [&](const std::string&) { ++lines; });
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&log] {
      for (int i = 0; i < 100; ++i) log.info("tick", {{"i", i}});
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(lines, Log::kLinesAPeriod);
}

}  // namespace
}  // namespace graspd

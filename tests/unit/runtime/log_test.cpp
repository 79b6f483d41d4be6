// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/runtime/log.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <stdexcept>
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

TEST(Log, ReportsTheNewestWarningOfEachKind) {
  ManualClock clock;
  Log log(clock, [](const std::string&) {});
  log.info("fine");
  log.warning("first", {{"n", 1}});
  clock.advance(1s);
  for (int i = 0; i < 50; ++i) log.error("second", {{"n", i}});
  clock.advance(1s);
  log.warning("first", {{"n", 2}});
  const std::vector<LogReport> reports = log.reports();
  ASSERT_EQ(reports.size(), 2u);
  EXPECT_EQ(reports[0].event, "first");
  EXPECT_EQ(reports[0].line, "event=first n=2");
  EXPECT_EQ(reports[0].count, 2);
  EXPECT_EQ(reports[0].utime, clock.wall_utime());
  EXPECT_EQ(reports[1].line, "event=second n=49") << "also what was held back";
  EXPECT_EQ(reports[1].count, 50);
  for (int i = 0; i < 40; ++i) log.error("kind" + std::to_string(i), {{"text", std::string(5000, 'x')}});
  EXPECT_EQ(log.reports().size(), Log::kMostReports);
  EXPECT_EQ(log.reports()[0].line.size(), Log::kLongestReport);
}

/// Standard error as a pipe that nobody reads for the time being.
class BlockedStandardError {
 public:
  BlockedStandardError() : saved_(dup(STDERR_FILENO)) {
    if (pipe(ends_.data()) != 0) throw std::runtime_error("no pipe");
    dup2(ends_[1], STDERR_FILENO);
  }
  ~BlockedStandardError() {
    dup2(saved_, STDERR_FILENO);
    close(saved_);
    close(ends_[0]);
  }
  /// From now on all is read, to the end.
  [[nodiscard]] std::thread reader(std::string& text) {
    return std::thread([this, &text] {
      std::array<char, 4096> buffer{};
      for (ssize_t n = 0; (n = read(ends_[0], buffer.data(), buffer.size())) > 0;)
        text.append(buffer.data(), static_cast<std::size_t>(n));
    });
  }
  void finish() {
    close(ends_[1]);
    dup2(saved_, STDERR_FILENO);
  }

 private:
  int saved_;
  std::array<int, 2> ends_{};
};

TEST(Log, NobodyWaitsForAReaderAndTheOldestLinesGo) {
  ManualClock clock;
  std::string text;
  BlockedStandardError blocked;
  std::thread reader;
  std::int64_t lost = 0;
  constexpr int kLines = 400;
  {
    Log log(clock, 16);
    const std::string long_text(10'000, 'x');  // a pipe holds 64 KiB, less than 16 lines
    for (int i = 0; i < kLines; ++i) {
      log.info("tick", {{"i", i}, {"text", long_text}});
      clock.advance(Log::kPeriod);
    }
    lost = log.lost();
    EXPECT_FALSE(log.flush()) << "nobody reads";
    reader = blocked.reader(text);
  }
  blocked.finish();
  reader.join();
  EXPECT_GT(lost, 100);
  EXPECT_LT(lost, kLines);
  EXPECT_NE(text.find("i=" + std::to_string(kLines - 1) + " "), std::string::npos) << "the newest is kept";
}

}  // namespace
}  // namespace graspd

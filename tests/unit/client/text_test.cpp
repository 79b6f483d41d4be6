// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/common/text.hpp"

#include <gtest/gtest.h>

#include "client/common/answer_summary.hpp"
#include "client/common/handle_text.hpp"
#include "client/common/live_text.hpp"
#include "tests/unit/client/sample_list.hpp"

namespace graspd {
namespace {

TEST(Text, PrintedHoldsAnyLength) {
  EXPECT_EQ(printed("%d %s", 7, "x"), "7 x");
  EXPECT_EQ(printed("%s", std::string(5000, 'y').c_str()), std::string(5000, 'y'));
  EXPECT_EQ(printed("%s", ""), "");
}

TEST(Text, PlainLineHasNoControlCharacters) {
  EXPECT_EQ(plain_line("a\x1b[2Jb\nü"), "a?[2Jb?ü");
}

TEST(Text, TablesLineUp) {
  TextTable table({"name", "n"});
  table.add({"ü", "1000"});
  table.add({"long name", "1"});
  table.add({"x"});
  EXPECT_EQ(table.str(), "name          n\nü          1000\nlong name     1\nx\n");
}

TEST(Text, PercentilesAreOfTheNearestRank) {
  EXPECT_EQ(percentile({}, 0.5), 0);
  EXPECT_EQ(percentile({3}, 0.99), 3);
  EXPECT_EQ(percentile({4, 1, 3, 2}, 0.5), 2);
  EXPECT_EQ(percentile({4, 1, 3, 2}, 0.99), 4);
  EXPECT_EQ(percentile({4, 1, 3, 2}, 0), 1);
}

TEST(LiveText, RedrawsInPlace) {
  EXPECT_EQ(redrawn("a\nb\n", true), "\x1b[2J\x1b[Ha\x1b[K\nb\x1b[K\n\x1b[J");
  EXPECT_EQ(redrawn("a\n", false), "\x1b[Ha\x1b[K\n\x1b[J");
}

TEST(HandleText, ShowsTheBestHandlesAndHowManyMoreThereAre) {
  const handle_list_t list = sample_list(5, 1);
  const std::string table = handle_table(list, 3);
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 5);
  EXPECT_NE(table.find("... and 2 more\n"), std::string::npos);
  EXPECT_EQ(handle_table(sample_list(0, 1), 3), "");
}

TEST(HandleText, TheLineSaysWhyThereIsNothing) {
  handle_list_t list = sample_list(0, 1);
  list.status = handle_list_t::REFUSED;
  list.status_text = "truncated\x1b: ends early";
  EXPECT_NE(handle_list_line(list).find("REFUSED (truncated?: ends early)"), std::string::npos);
}

TEST(HandleText, EveryStatusHasAName) {
  EXPECT_EQ(status_name(handle_list_t::OK), "OK");
  EXPECT_EQ(status_name(handle_list_t::NOTHING_IN_WORKSPACE), "NOTHING_IN_WORKSPACE");
  EXPECT_EQ(status_name(handle_list_t::FAILED), "FAILED");
  EXPECT_EQ(status_name(-1), "UNKNOWN");
  EXPECT_EQ(status_name(100), "UNKNOWN");
}

TEST(AnswerSummary, CountsByStatusAndLeavesDroppedFramesOutOfTheLatency) {
  AnswerSummary summary;
  handle_list_t list = sample_list(4, 1);
  list.latency = 0.010;
  summary.add(list);
  summary.add(list);
  list = sample_list(0, 1);
  list.latency = 0.020;
  summary.add(list);
  list.status = handle_list_t::OVERLOADED;
  list.latency = 5;
  summary.add(list);
  EXPECT_EQ(summary.answers(), 4);
  EXPECT_EQ(summary.str(),
            "answers           4: OK 2, NO_HANDLES 1, OVERLOADED 1\n"
            "latency           p50 10.0 ms, p99 20.0 ms\n"
            "handles per frame 2.7\n");
}

}  // namespace
}  // namespace graspd

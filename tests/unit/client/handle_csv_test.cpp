// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/common/handle_csv.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <sstream>
#include <vector>

#include "tests/unit/client/sample_list.hpp"

namespace graspd {
namespace {

/// Cells of a line without quotes.
std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> result(1);
  for (const char c : line) {
    if (c == ',') {
      result.emplace_back();
    } else {
      result.back() += c;
    }
  }
  return result;
}

using Row = std::map<std::string, std::string>;

std::vector<Row> rows(const std::string& text) {
  std::istringstream stream(text);
  std::string line;
  std::getline(stream, line);
  const auto names = cells(line);
  std::vector<Row> result;
  while (std::getline(stream, line)) {
    const auto values = cells(line);
    EXPECT_EQ(values.size(), names.size()) << line;
    Row row;
    for (std::size_t i = 0; i < names.size() && i < values.size(); ++i) row[names[i]] = values[i];
    result.push_back(row);
  }
  return result;
}

float number(const Row& row, const std::string& column) {
  return std::strtof(row.at(column).c_str(), nullptr);
}

TEST(HandleCsv, NumbersComeBackToTheBit) {
  const handle_list_t list = sample_list(200, 3);
  const auto read = rows(handle_csv_header() + handle_csv_rows(list));
  ASSERT_EQ(read.size(), list.handles.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    const handle_t& h = list.handles[i];
    const Row& row = read[i];
    const auto expect = [&](const std::string& column, double value) {
      EXPECT_EQ(number(row, column), static_cast<float>(value)) << column;
    };
    expect("px", h.position[0]);
    expect("py", h.position[1]);
    expect("pz", h.position[2]);
    expect("qw", h.orientation[0]);
    expect("qx", h.orientation[1]);
    expect("qy", h.orientation[2]);
    expect("qz", h.orientation[3]);
    expect("roll", h.rpy[0]);
    expect("pitch", h.rpy[1]);
    expect("yaw", h.rpy[2]);
    expect("width", h.width);
    expect("gap_neg", h.gap[0]);
    expect("gap_pos", h.gap[1]);
    expect("observed_neg", h.observed_free[0]);
    expect("observed_pos", h.observed_free[1]);
    expect("score", h.score);
  }
}

TEST(HandleCsv, SaysWhichFrameAndKeepsTheOrder) {
  const auto read = rows(handle_csv_header() + handle_csv_rows(sample_list(3, 4)));
  ASSERT_EQ(read.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(read[i].at("frame"), "learn7");
    EXPECT_EQ(read[i].at("seq"), "7");
    EXPECT_EQ(read[i].at("utime"), "1700000000123456");
    EXPECT_EQ(read[i].at("channel"), "GRASPD_CLOUD");
    EXPECT_EQ(read[i].at("id"), std::to_string(i));
    EXPECT_EQ(read[i].at("segment"), std::to_string(3 * i));
    EXPECT_EQ(read[i].at("points"), std::to_string(100 + i));
    EXPECT_EQ(read[i].at("status"), "OK");
  }
}

TEST(HandleCsv, ListsWithoutHandlesGiveNoLineUnlessWanted) {
  const handle_list_t list = sample_list(0, 5);
  EXPECT_EQ(handle_csv_rows(list), "");
  const auto read = rows(handle_csv_header() + handle_csv_rows(list, EmptyLists::kWriteRow));
  ASSERT_EQ(read.size(), 1u);
  EXPECT_EQ(read[0].at("id"), "-1");
  EXPECT_EQ(read[0].at("px"), "");
  EXPECT_EQ(read[0].at("status"), "NO_HANDLES");
}

TEST(HandleCsv, AwkwardNamesAreQuoted) {
  EXPECT_EQ(csv_cell("plain name"), "plain name");
  EXPECT_EQ(csv_cell("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_cell("say \"hi\"\n"), "\"say \"\"hi\"\"\n\"");
}

}  // namespace
}  // namespace graspd

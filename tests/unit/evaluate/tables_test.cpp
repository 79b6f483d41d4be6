// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/tables.hpp"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <sstream>
#include <utility>

namespace graspd {
namespace {

std::vector<JudgedFrame> two_frames() {
  JudgedHandle good, bad;
  good.object = 2;
  good.valid = true;
  good.handle.score = 0.9f;
  bad.object = 3;
  bad.failure = "fingers";
  bad.handle.score = 0.4f;
  return {{"learn1", "boxes", {2, 3}, {good, bad}}, {"odd, \"name\" | pipe", "", {}, {}}};
}

std::vector<Table> all_tables(const std::vector<JudgedFrame>& frames) {
  const NamedRun run{"run", frames};
  return {frame_table(frames),         object_table(frames),  figures_table(std::span(&run, 1)),
          category_table(frames),      failure_table(frames), calibration_table(frames),
          invalid_handle_table(frames)};
}

std::vector<std::string> lines(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> result;
  for (std::string line; std::getline(stream, line);) result.push_back(line);
  return result;
}

TEST(Tables, EveryRowHasACellForEveryColumn) {
  for (const auto& frames : {std::vector<JudgedFrame>(), two_frames()}) {
    for (const Table& table : all_tables(frames))
      for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size()) << table.name;
  }
}

TEST(Tables, JsonReadsBack) {
  const auto tables = all_tables(two_frames());
  const YAML::Node json = YAML::Load(write_tables(tables, TableFormat::kJson));  // JSON is YAML
  for (const Table& table : tables) EXPECT_EQ(json[table.name].size(), table.rows.size()) << table.name;
  const YAML::Node run = json["figures"][0];
  EXPECT_EQ(run["recall"].as<double>(), 0.5);
  EXPECT_EQ(run["precision"].as<double>(), 0.5);
  EXPECT_EQ(run["recall_1"].as<double>(), 0.5);
  EXPECT_EQ(run["handles_frame"].as<double>(), 1);
  EXPECT_EQ(json["frames"][1]["frame"].as<std::string>(), "odd, \"name\" | pipe");
  EXPECT_TRUE(json["frames"][1]["recall"].IsNull());
}

TEST(Tables, CsvHasOneHeaderABlockAndQuotesNames) {
  const auto text = write_tables(std::vector{frame_table(two_frames())}, TableFormat::kCsv);
  const auto rows = lines(text);
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0], "table,frame,objects,handles,valid,objects_found,recall,precision");
  EXPECT_EQ(rows[1], "frames,learn1,2,2,1,1,0.5,0.5");
  EXPECT_EQ(rows[2], "frames,\"odd, \"\"name\"\" | pipe\",0,0,0,0,,");
  EXPECT_EQ(rows[3], "frames,total,2,2,1,1,0.5,0.5");
}

TEST(Tables, MarkdownRowsHaveTheSameNumberOfCells) {
  for (const Table& table : all_tables(two_frames())) {
    const auto rows = lines(write_tables(std::span(&table, 1), TableFormat::kMarkdown));
    EXPECT_EQ(rows[0], "## " + table.title);
    for (std::size_t i = 2; i < rows.size(); ++i) {
      std::string row = rows[i];
      for (auto at = row.find("\\|"); at != row.npos; at = row.find("\\|")) row.erase(at, 2);
      EXPECT_EQ(std::count(row.begin(), row.end(), '|'), std::ssize(table.columns) + 1) << row;
    }
  }
}

TEST(Tables, MarkdownShowsPercentages) {
  const std::string text = write_tables(std::vector{frame_table(two_frames())}, TableFormat::kMarkdown);
  EXPECT_NE(text.find("| learn1 | 2 | 2 | 1 | 1 | 50.0 % | 50.0 % |"), text.npos) << text;
}

TEST(Tables, NothingToShowIsStillATable) {
  const YAML::Node json = YAML::Load(write_tables(all_tables({}), TableFormat::kJson));
  EXPECT_TRUE(json["frames"].IsSequence());
  EXPECT_TRUE(json["figures"][0]["recall"].IsNull());
  EXPECT_EQ(write_tables({}, TableFormat::kJson), "{}\n");
  EXPECT_EQ(write_tables({}, TableFormat::kMarkdown), "");
}

TEST(Tables, RunsSideBySideShowTheSameFigures) {
  const std::vector<NamedRun> runs{{"a", two_frames()}, {"b", two_frames()}};
  for (const auto& [both, one] : {std::pair{frame_table_side_by_side(runs), frame_table(two_frames())},
                                  {object_table_side_by_side(runs), object_table(two_frames())}}) {
    EXPECT_EQ(both.rows.size(), one.rows.size());
    for (const auto& row : both.rows) EXPECT_EQ(row.size(), both.columns.size());
  }
  const Table frames = frame_table_side_by_side(runs);
  EXPECT_EQ(frames.columns[2], "a handles");
  EXPECT_EQ(std::get<std::int64_t>(frames.rows[0][5]), 2);
  EXPECT_EQ(*std::get<Percentage>(frames.rows[2][7]).value, 0.5);
  EXPECT_EQ(object_table_side_by_side({}).rows.size(), 0u);
  EXPECT_EQ(frame_table_side_by_side({}).rows.size(), 1u);
}

TEST(Tables, InvalidHandlesComeWithTheirReason) {
  const Table table = invalid_handle_table(two_frames());
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(std::get<std::string>(table.rows[0].front()), "learn1");
  EXPECT_EQ(std::get<std::int64_t>(table.rows[0][1]), 1);
  EXPECT_EQ(std::get<std::string>(table.rows[0].back()), "fingers");
}

}  // namespace
}  // namespace graspd

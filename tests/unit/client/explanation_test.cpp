// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/detect/explanation.hpp"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "client/common/handle_text.hpp"
#include "client/simulate/simulation.hpp"

namespace graspd {
namespace {

std::vector<std::string> lines(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> result;
  for (std::string line; std::getline(stream, line);) result.push_back(line);
  return result;
}

std::vector<std::string> cells(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> result;
  for (std::string cell; std::getline(stream, cell, ',');) result.push_back(cell);
  return result;
}

SegmentReport segment_with(int handles, std::vector<std::pair<Failure, int>> failures) {
  SegmentReport segment;
  segment.centroid = {0.1f, -0.25f, 0.5f};
  segment.num_points = 77;
  segment.object = 4;
  segment.num_handles = segment.num_candidates = handles;
  for (const auto& [failure, count] : failures) {
    segment.failures[static_cast<std::size_t>(failure)] = count;
    segment.num_candidates += count;
  }
  return segment;
}

/// Segments: one with a listed handle, one with handles that are not listed, one too wide, one never tried.
FileDetection sample() {
  FileDetection detected;
  detected.list.frame_name = "a,b";
  detected.list.seq = 3;
  detected.list.handles.resize(1);
  detected.list.handles[0].segment_id = 0;
  detected.list.num_handles = 1;
  detected.segments = {segment_with(2, {{Failure::kWalls, 1}}), segment_with(1, {}),
                       segment_with(0, {{Failure::kTooWide, 12}, {Failure::kFingers, 3}}),
                       segment_with(0, {})};
  return detected;
}

/// A frame of a cluttered table, through the real pipeline.
FileDetection detected_frame(const SourceConfig& source = {}) {
  SimulationConfig config;
  config.camera = {320, 240, 262.5, 262.5, 159.5, 119.5};
  return detect_in_cloud(to_cloud(Simulation(config).frame(0)).cloud, "frame", 7, source);
}

TEST(Explanation, NoSegments) {
  const FileDetection nothing = detect_in_cloud(PointCloud{}, "nothing", 0, SourceConfig{});
  EXPECT_EQ(explanation_table(nothing), "no segments\n");
  EXPECT_EQ(explanation_csv_rows(nothing), "");
  EXPECT_EQ(YAML::Load(explanation_json(nothing))["segments"].size(), 0u);
}

TEST(Explanation, EveryFailureHasWordsOfItsOwn) {
  std::set<std::string_view> words;
  for (std::size_t i = 0; i <= kNumFailures; ++i) {
    const std::string_view text = in_words(static_cast<Failure>(i));
    EXPECT_EQ(text.find('_'), std::string_view::npos) << "words, not names: " << text;
    EXPECT_GT(text.size(), 8u);
    EXPECT_TRUE(words.insert(text).second) << text;
  }
}

TEST(Explanation, TheTableSaysWhyNot) {
  const std::vector<std::string> table = lines(explanation_table(sample()));
  ASSERT_EQ(table.size(), 6u);
  EXPECT_TRUE(table[0].starts_with("segment"));
  EXPECT_NE(table[0].find("  why not"), std::string::npos);
  EXPECT_TRUE(table[1].ends_with("1")) << "held: nothing to explain: " << table[1];
  EXPECT_NE(table[2].find("left out of the list"), std::string::npos) << table[2];
  EXPECT_TRUE(table[3].ends_with(std::string(in_words(Failure::kFingers)) + " (too_wide 12, fingers 3)"))
      << "the reason is the last check that was reached: " << table[3];
  EXPECT_NE(table[4].find("no candidate"), std::string::npos) << table[4];
  EXPECT_EQ(table[5], "segments without a handle: too_few_points 1, fingers 1");
  // The words begin in one column.
  EXPECT_EQ(table[2].find("left out"), table[0].find("why not"));
}

TEST(Explanation, CsvHasACellForEachColumn) {
  const std::vector<std::string> names = cells(lines(explanation_csv_header())[0]);
  const std::vector<std::string> rows = lines(explanation_csv_rows(sample()));
  ASSERT_EQ(rows.size(), 4u);
  for (const std::string& row : rows) {
    // The frame's name holds a comma and is in quotes: a cell more for this plain reader.
    ASSERT_TRUE(row.starts_with("\"a,b\",3,")) << row;
    const std::vector<std::string> values = cells(row);
    ASSERT_EQ(values.size(), names.size() + 1) << row;
    for (const std::string& value : values) EXPECT_FALSE(value.empty()) << row;
  }
  const auto column = [&names](const char* name) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin()) + 1;
  };
  const std::vector<std::string> wide = cells(rows[2]);
  EXPECT_EQ(wide.at(column("segment")), "2");
  EXPECT_EQ(wide.at(column("object")), "4");
  EXPECT_EQ(wide.at(column("py")), "-0.25");
  EXPECT_EQ(wide.at(column("points")), "77");
  EXPECT_EQ(wide.at(column("candidates")), "15");
  EXPECT_EQ(wide.at(column("reason")), "fingers");
  EXPECT_EQ(wide.at(column("too_wide")), "12");
  EXPECT_EQ(wide.at(column("unseen")), "0");
  const std::vector<std::string> held = cells(rows[0]);
  EXPECT_EQ(held.at(column("handles")), "2");
  EXPECT_EQ(held.at(column("listed")), "1");
  EXPECT_EQ(held.at(column("reason")), "none");
}

TEST(Explanation, JsonIsTheListsWithSegments) {
  const FileDetection detected = sample();
  const std::string list = handle_list_json(detected.list), explained = explanation_json(detected);
  EXPECT_TRUE(explained.starts_with(list.substr(0, list.size() - 1))) << "every member of the list is there";
  EXPECT_EQ(explained.find('\n'), std::string::npos);
  const YAML::Node segments = YAML::Load(explained)["segments"];
  ASSERT_EQ(segments.size(), 4u);
  EXPECT_EQ(segments[2]["reason"].as<std::string>(), "fingers");
  EXPECT_EQ(segments[2]["failures"]["too_wide"].as<int>(), 12);
  EXPECT_EQ(segments[2]["failures"].size(), 2u);
  EXPECT_EQ(segments[2]["centroid"][1].as<float>(), -0.25f);
  EXPECT_EQ(segments[0]["num_listed"].as<int>(), 1);
  EXPECT_EQ(segments[1]["num_handles"].as<int>(), 1);
}

TEST(Explanation, AddsUpToTheList) {
  const FileDetection detected = detected_frame();
  ASSERT_FALSE(detected.list.handles.empty());
  ASSERT_EQ(static_cast<int>(detected.segments.size()), detected.list.num_segments);
  const YAML::Node segments = YAML::Load(explanation_json(detected))["segments"];
  std::size_t candidates = 0, listed = 0;
  std::map<std::string, std::int64_t> without;
  for (const YAML::Node& segment : segments) {
    std::size_t tried = segment["num_handles"].as<std::size_t>();
    for (const auto& failure : segment["failures"]) tried += failure.second.as<std::size_t>();
    EXPECT_EQ(tried, segment["num_candidates"].as<std::size_t>());
    candidates += tried;
    listed += segment["num_listed"].as<std::size_t>();
    EXPECT_LE(segment["num_listed"].as<int>(), segment["num_handles"].as<int>());
    if (segment["num_handles"].as<int>() == 0) ++without[segment["reason"].as<std::string>()];
  }
  EXPECT_EQ(candidates, static_cast<std::size_t>(detected.list.num_candidates));
  EXPECT_EQ(listed, detected.list.handles.size());
  std::map<std::string, std::int64_t> told;
  for (const reason_count_t& count : detected.list.segment_failures) told[count.reason] = count.count;
  EXPECT_EQ(without, told);
}

TEST(Explanation, CentroidsAreInTheFrameOfTheHandles) {
  SourceConfig moved;
  moved.sensor_pose.frame_name = "base";
  moved.sensor_pose.position_m = {0.3f, 0.1f, 1.2f};
  moved.sensor_pose.rpy_rad = {-2.2, 0.1, 0.7};
  const FileDetection here = detected_frame(), there = detected_frame(moved);
  ASSERT_EQ(here.segments.size(), there.segments.size());
  const Eigen::Isometry3f T = moved.sensor_pose.T_target_cloud();
  for (std::size_t i = 0; i < here.segments.size(); ++i)
    EXPECT_LT((T * here.segments[i].centroid - there.segments[i].centroid).norm(), 1e-5f);
}

}  // namespace
}  // namespace graspd

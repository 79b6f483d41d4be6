// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/status/status_text.hpp"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>

#include "client/common/replace_file.hpp"
#include "client/status/prometheus.hpp"
#include "tests/support/temp_folder.hpp"

namespace graspd {
namespace {

status_t sample_status() {
  status_t status{};
  status.version = "0.1.0";
  status.host = "robot";
  status.pid = 42;
  status.uptime = 3725.4;
  status.rss = 123'000'000;
  source_status_t source{};
  source.name = "wrist";
  source.channel = "WRIST_CLOUD";
  source.received = 100;
  source.processed = 90;
  source.dropped = 8;
  source.refused = 2;
  source.latency_p50 = 0.0123;
  source.refusals = {{"truncated", 2}};
  source.num_refusals = 1;
  source.last_error = "ends before\nits data";
  source.drops = {{"newer_frame", 7}, {"deadline", 1}};
  source.num_drops = 2;
  source.age = 0.25;
  status.config_revision = 4;
  status.receive_errors = 12;
  status.reassembly_errors = -1;
  status.errors = {{1, "frame_refused", "event=frame_refused reason=\"a\nb\"", 2}};
  status.num_errors = 1;
  status.sources = {source};
  status.num_sources = 1;
  return status;
}

TEST(StatusJson, ReadsBack) {
  const YAML::Node json = YAML::Load(status_json(sample_status()));
  EXPECT_EQ(json["state"].as<std::string>(), "running");
  EXPECT_EQ(json["rss"].as<std::int64_t>(), 123'000'000);
  EXPECT_EQ(json["sources"][0]["dropped"].as<int>(), 8);
  EXPECT_EQ(json["sources"][0]["refusals"]["truncated"].as<int>(), 2);
  EXPECT_EQ(json["sources"][0]["drops"]["newer_frame"].as<int>(), 7);
  EXPECT_EQ(json["receive_errors"].as<int>(), 12);
  EXPECT_EQ(json["errors"][0]["event"].as<std::string>(), "frame_refused");
}

TEST(StatusText, NamesTheSourceAndItsLastError) {
  const std::string text = status_text(sample_status());
  EXPECT_NE(text.find("graspd 0.1.0 on robot (pid 42) running for 1:02:05"), std::string::npos) << text;
  EXPECT_NE(text.find("wrist   WRIST_CLOUD       100         90        8        2"), std::string::npos)
      << text;
  EXPECT_NE(text.find("12 datagrams lost: a receive buffer was full"), std::string::npos) << text;
  EXPECT_NE(text.find("WRIST_CLOUD: dropped: newer_frame 7, deadline 1\n"), std::string::npos) << text;
  EXPECT_NE(text.find("2 times: event=frame_refused"), std::string::npos) << text;
  EXPECT_NE(text.find("WRIST_CLOUD: last error: ends before?its data\n"), std::string::npos) << text;
}

TEST(Prometheus, EveryFamilyHasHelpAndTypeOnce) {
  std::istringstream lines(prometheus_text(sample_status()));
  std::set<std::string> families;
  std::string line;
  std::string family;
  while (std::getline(lines, line)) {
    if (line.starts_with("# HELP ")) {
      family = line.substr(7, line.find(' ', 7) - 7);
      EXPECT_TRUE(families.insert(family).second) << line;
    } else if (line.starts_with("# TYPE ")) {
      EXPECT_TRUE(line == "# TYPE " + family + (family.ends_with("_total") ? " counter" : " gauge")) << line;
    } else {
      EXPECT_EQ(line.substr(0, line.find_first_of("{ ")), family) << line;
      EXPECT_TRUE(family.starts_with("graspd_"));
    }
  }
  EXPECT_GT(families.size(), 20u);
}

TEST(Prometheus, SaysWhatTheStatusSays) {
  const std::string text = prometheus_text(sample_status());
  for (const char* line : {
           "graspd_up 1\n",
           "graspd_info{version=\"0.1.0\",host=\"robot\"} 1\n",
           "graspd_frames_received_total{source=\"wrist\",channel=\"WRIST_CLOUD\"} 100\n",
           "graspd_frames_dropped_total{source=\"wrist\",channel=\"WRIST_CLOUD\",reason=\"deadline\"} 1\n",
           "graspd_latency_seconds{source=\"wrist\",channel=\"WRIST_CLOUD\",quantile=\"0.5\"} 0.0123",
           "graspd_kernel_receive_errors_total 12\n",
           "graspd_config_refused 0\n",
       }) {
    EXPECT_NE(text.find(line), std::string::npos) << line << text;
  }
  EXPECT_EQ(text.find("reassembly"), std::string::npos) << "unknown is left out";
  EXPECT_EQ(prometheus_down(),
            "# HELP graspd_up Whether the daemon was heard.\n# TYPE graspd_up gauge\ngraspd_up 0\n");
}

TEST(Prometheus, LabelsCannotBreakOut) {
  status_t status = sample_status();
  status.sources[0].name = "a\"b\\c\nd";
  EXPECT_NE(prometheus_text(status).find("{source=\"a\\\"b\\\\c\\nd\","), std::string::npos);
}

TEST(ReplaceFile, WritesAllOrLeavesTheOld) {
  const TempFolder folder;
  const auto file = folder.path() / "metrics.prom";
  replace_file(file, "first\n");
  EXPECT_EQ(read_bytes(file), "first\n");
  replace_file(file, "second\n");
  EXPECT_EQ(read_bytes(file), "second\n");
  EXPECT_FALSE(std::filesystem::exists(file.string() + ".tmp"));
  EXPECT_THROW(replace_file(folder.path() / "none" / "metrics.prom", "x"), std::runtime_error);
  std::filesystem::create_directory(folder.path() / "taken");
  EXPECT_THROW(replace_file(folder.path() / "taken", "x"), std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "taken.tmp"));
}

TEST(ReplaceFile, AFullDiskIsToldAndTheOldTextStays) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  const TempFolder folder;
  const auto file = folder.path() / "metrics.prom";
  replace_file(file, "old\n");
  std::filesystem::create_symlink("/dev/full", file.string() + ".tmp");
  EXPECT_THROW(replace_file(file, "new\n"), std::runtime_error);
  EXPECT_EQ(read_bytes(file), "old\n");
}

}  // namespace
}  // namespace graspd

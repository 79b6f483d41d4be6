// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The parts of graspd-bench whose results do not depend on time.
#include <gtest/gtest.h>

#include <stdexcept>

#include "client/bench/bench_clouds.hpp"
#include "client/bench/bench_options.hpp"
#include "client/bench/bench_report.hpp"
#include "client/bench/measure.hpp"
#include "client/bench/memory_use.hpp"
#include "service/pipeline/downsample.hpp"

namespace graspd {
namespace {

TEST(Samples, QuantilesAreLinearBetweenTheNearest) {
  EXPECT_EQ(Samples{}.median(), 0);
  EXPECT_EQ(Samples{{7}}.quantile(0.99), 7);
  const Samples samples{{4, 1, 3, 2}};
  EXPECT_EQ(samples.min(), 1);
  EXPECT_EQ(samples.max(), 4);
  EXPECT_DOUBLE_EQ(samples.median(), 2.5);
  EXPECT_DOUBLE_EQ(samples.quantile(0.25), 1.75);
  EXPECT_DOUBLE_EQ((Samples{{5, 9, 1}}).median(), 5);
}

TEST(BenchResult, SeriesKeepTheOrderTheyCameIn) {
  BenchResult result;
  result.add_time("b", 1);
  result.add_time("a", 2);
  result.add_time("b", 3);
  ASSERT_EQ(result.times.size(), 2u);
  EXPECT_EQ(result.times[0].name, "b");
  EXPECT_EQ(result.find("b")->values, (std::vector<double>{1, 3}));
  EXPECT_EQ(result.find("c"), nullptr);
}

TEST(BenchOptions, SuitesComeInTheirOrderEachOnce) {
  BenchOptions options;
  EXPECT_EQ(suites_to_run(options), (std::vector<std::string>{"stages", "points", "codec"}));
  options.suites = {"lcm", "stages", "lcm"};
  EXPECT_EQ(suites_to_run(options), (std::vector<std::string>{"stages", "lcm"}));
  options.suites = {"all"};
  EXPECT_EQ(suites_to_run(options).size() + 1, suite_names().size());
}

TEST(BenchOptions, WhatDoesNotGoTogetherIsRefused) {
  EXPECT_FALSE(problem(BenchOptions{}));
  BenchOptions options;
  options.suites = {"codec"};
  EXPECT_FALSE(problem(options));
  options.inputs = {"cloud.pcd"};
  EXPECT_TRUE(problem(options));
  options.inputs.clear();
  options.plot_file = "plot.svg";
  EXPECT_TRUE(problem(options));
  options.suites = {"points"};
  EXPECT_FALSE(problem(options));
  options.points = {1000};
  EXPECT_TRUE(problem(options));
}

TEST(BenchOptions, ThreadsGoFromOneToAll) {
  EXPECT_EQ(thread_counts({}, 1), std::vector<int>{1});
  EXPECT_EQ(thread_counts({}, 2), (std::vector<int>{1, 2}));
  EXPECT_EQ(thread_counts({}, 12), (std::vector<int>{1, 2, 3, 4, 8, 12}));
  EXPECT_EQ(outer_thread_counts({}, 12), (std::vector<int>{1, 12}));
  BenchOptions options;
  options.threads = {3};
  EXPECT_EQ(thread_counts(options, 12), std::vector<int>{3});
}

TEST(BenchOptions, ConfigurationsAreValidAtEveryResolution) {
  for (const float leaf_m : {0.0008f, 0.0045f, 0.02f}) {
    EXPECT_FALSE(config_at(leaf_m).validate());
    EXPECT_FALSE(plain_config(config_at(leaf_m)).validate());
  }
  EXPECT_FALSE(plain_config({}).search.seeds);
  EXPECT_TRUE(plain_config({}).search.bands);
}

TEST(Measure, RoundsAreSpreadEvenly) {
  for (const int some : {1, 3, 5, 20, 50}) {
    int turns = 0, last = -1;
    for (int round = 0; round < 20; ++round) {
      if (!takes_part(round, 20, some)) continue;
      ++turns;
      EXPECT_LE(round - last, 20 / std::min(some, 20) + 1);
      last = round;
    }
    EXPECT_EQ(turns, std::min(some, 20));
  }
}

TEST(BenchClouds, LeafLeavesTheWantedNumberOfPoints) {
  PointCloud plane;
  for (int i = 0; i < 300; ++i)
    for (int j = 0; j < 300; ++j)
      plane.push_back({0.001f * static_cast<float>(i), 0.0011f * static_cast<float>(j), 1});
  const std::size_t count = downsample(plane, {leaf_for(plane, 2000)}).cloud.size();
  EXPECT_NEAR(static_cast<double>(count), 2000, 100);
  EXPECT_THROW((void)leaf_for(plane, 100'000), std::invalid_argument);
  EXPECT_THROW((void)leaf_for(plane, 0), std::invalid_argument);
}

TEST(BenchClouds, LargerCloudsAreTheSameSceneFiner) {
  const BenchCloud small = scaled_cloud({}, 2000), large = scaled_cloud({}, 8000);
  EXPECT_NEAR(static_cast<double>(small.cloud.size()), 2000, 100);
  EXPECT_NEAR(static_cast<double>(large.cloud.size()), 8000, 400);
  EXPECT_NEAR(static_cast<double>(small.leaf_m / large.leaf_m), 2, 0.2);
  EXPECT_EQ(scaled_cloud({}, 2000).cloud.x, small.cloud.x);
}

TEST(MemoryUse, SeesWhatIsTouched) {
  constexpr std::size_t kBytes = 32 << 20;
  const auto growth = peak_growth_bytes([] {
    std::vector<char> block(kBytes, 1);
    ASSERT_EQ(block.back(), 1);
  });
  if (!growth) GTEST_SKIP() << "the kernel does not tell peaks";
  EXPECT_GE(*growth, static_cast<std::int64_t>(kBytes) / 2);
}

TEST(SvgPlot, TicksEncloseTheValues) {
  EXPECT_EQ(log_ticks(1, 10), (std::vector<double>{1, 2, 5, 10}));
  EXPECT_EQ(log_ticks(3, 3), (std::vector<double>{2, 5}));
  const std::vector<double> ticks = log_ticks(0.07, 900);
  EXPECT_DOUBLE_EQ(ticks.front(), 0.05);
  EXPECT_DOUBLE_EQ(ticks.back(), 1000);
  EXPECT_EQ(tick_label(20000), "20k");
  EXPECT_EQ(tick_label(1e6), "1M");
  EXPECT_EQ(tick_label(0.5), "0.5");
}

TEST(SvgPlot, LabelsKeepTheirOrderAndTheirDistance) {
  EXPECT_EQ(spread({10, 50, 30}, 15), (std::vector<double>{10, 50, 30}));
  const std::vector<double> places = spread({20, 20, 22}, 10);
  EXPECT_DOUBLE_EQ(places[1] - places[0], 10);
  EXPECT_DOUBLE_EQ(places[2] - places[1], 10);
  EXPECT_DOUBLE_EQ(places[0] + places[1] + places[2], 62);
}

TEST(SvgPlot, DrawsEveryLineAndRefusesWhatHasNoLogarithm) {
  const Plot plot{"a < b", "x", "y", {{"first", 0, false, {{1, 1}, {10, 5}}}, {"second", 1, true, {{1, 2}}}}};
  const std::string text = svg(plot);
  EXPECT_NE(text.find("first"), std::string::npos);
  EXPECT_NE(text.find("second"), std::string::npos);
  EXPECT_NE(text.find("a &lt; b"), std::string::npos);
  EXPECT_THROW((void)svg({}), std::invalid_argument);
  EXPECT_THROW((void)svg({"", "", "", {{"zero", 0, false, {{1, 0}}}}}), std::invalid_argument);
}

TEST(BenchReport, ThePlotHasALineForEachSeriesAndNumberOfThreads) {
  BenchRun run;
  for (const int threads : {1, 2})
    for (const std::size_t points : {1000, 2000}) {
      BenchResult result{"points", "", threads, points, 0, {}, {}};
      result.add_time(kWhole, 1);
      result.add_time(kPcl, 2);
      run.results.push_back(result);
    }
  run.results.push_back({"codec", "", 1, 9, 0, {{std::string(kWhole), {{3}}}}, {}});
  const Plot plot = cost_plot(run);
  ASSERT_EQ(plot.lines.size(), 4u);
  for (const PlotLine& line : plot.lines) EXPECT_EQ(line.points.size(), 2u);
}

}  // namespace
}  // namespace graspd

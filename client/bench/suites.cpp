// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/bench/suites.hpp"

#include <algorithm>
#include <thread>
#include <variant>

#include "client/bench/measure.hpp"
#include "client/bench/memory_use.hpp"
#include "client/common/stop_flag.hpp"
#include "client/common/text.hpp"

namespace graspd {
namespace {

int all_threads() {
  return static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

/// What a detection that keeps nothing from before needs beside the cloud itself.
std::optional<double> memory_per_point(const BenchCloud& bench, const DetectConfig& config, int threads) {
  ThreadLimit limit(threads);
  const auto bytes = peak_growth_bytes([&] { (void)timed_detection(bench.cloud, config, limit.arena()); });
  if (!bytes) return std::nullopt;
  return static_cast<double>(*bytes) / static_cast<double>(bench.cloud.size());
}

}  // namespace

void run_stages(const BenchOptions& options, const ResultSink& sink) {
  for (const BenchCloud& bench : stage_clouds(options))
    for (const int threads : thread_counts(options, all_threads())) {
      if (stop_requested()) return;
      sink(measure_in_turns("stages", bench, config_at(bench.leaf_m), threads, options));
    }
}

void run_points(const BenchOptions& options, const ResultSink& sink) {
  for (const std::int64_t count : point_counts(options)) {
    const BenchCloud bench = scaled_cloud(options, static_cast<std::size_t>(count));
    const DetectConfig config = config_at(bench.leaf_m);
    for (const int threads : outer_thread_counts(options, all_threads())) {
      if (stop_requested()) return;
      const auto memory = memory_per_point(bench, config, threads);
      BenchResult result = measure_in_turns("points", bench, config, threads, options);
      result.figures.emplace_back("leaf_mm", 1e3 * static_cast<double>(bench.leaf_m));
      if (memory) result.figures.emplace_back("memory_bytes_per_point", *memory);
      sink(std::move(result));
    }
  }
}

void run_organized(const BenchOptions& options, const ResultSink& sink) {
  for (const int width : {options.width, options.width / 2}) {
    const PointCloud cloud = simulated_image(options, 0, width).cloud;
    const BenchCloud bench{printed("%d x %d", cloud.width, cloud.height), cloud, 0};
    BenchCloud blocks = bench;
    blocks.name += ", blocks";
    DetectConfig by_blocks;
    by_blocks.downsample.image_blocks = true;
    BenchOptions alone = options;
    alone.no_pcl = true;  // it has had its turns on the same image
    for (const int threads : outer_thread_counts(options, all_threads())) {
      if (stop_requested()) return;
      sink(measure_in_turns("organized", bench, DetectConfig{}, threads, options));
      if (stop_requested()) return;
      sink(measure_in_turns("organized", blocks, by_blocks, threads, alone));
    }
  }
}

BenchRun run_suites(const BenchOptions& options, const ResultSink& sink) {
  using Suite = void (*)(const BenchOptions&, const ResultSink&);
  const std::pair<std::string_view, Suite> suites[] = {
      {"stages", run_stages}, {"points", run_points}, {"organized", run_organized}, {"codec", run_codec}};
  BenchRun run;
  const auto keep = [&](BenchResult result) {
    run.results.push_back(result);
    sink(std::move(result));
  };
  for (const std::string& name : suites_to_run(options)) {
    if (stop_requested()) break;
    for (const auto& [suite, measure] : suites)
      if (suite == name) measure(options, keep);
    if (name != "lcm") continue;
    try {
      run_lcm(options, keep);
    } catch (const std::runtime_error& error) {
      run.skipped.push_back({name, error.what()});
    }
  }
  return run;
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/benchmark/measure.hpp"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <string_view>

#include "client/common/stop_flag.hpp"
#include "service/pipeline/detect_handles.hpp"
#include "tests/benchmark/pcl_baseline.hpp"

namespace graspd {
namespace {

using Clock = std::chrono::steady_clock;
using StageTimes = std::vector<std::pair<std::string, double>>;

double ms_between(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double, std::milli>(to - from).count();
}

/// The stages that do what PCL is timed for; the support's points take no part in the others because it was
/// found.
bool is_counterpart(std::string_view stage) {
  return stage == "support" || stage == "neighborhoods" || stage == "normals" || stage == "edge_points" ||
         stage == "region_growing";
}

struct DetectRun {
  Detection detection;
  double total_ms = 0;
  StageTimes stages;
};

DetectRun run_detection(const BenchCloud& bench, const BenchSettings& settings, tbb::task_arena& arena) {
  DetectRun run;
  const auto start = Clock::now();
  auto last = start;
  arena.execute([&] {
    run.detection =
        detect_handles(bench.cloud, settings.gripper, settings.config, [&](std::string_view stage) {
          const auto now = Clock::now();
          run.stages.emplace_back(stage, ms_between(last, now));
          last = now;
        });
  });
  run.total_ms = ms_between(start, Clock::now());
  return run;
}

void add(const DetectRun& run, Measurement& m) {
  m.detect.ms.push_back(run.total_ms);
  double surfaces_ms = 0;
  for (std::size_t i = 0; i < run.stages.size(); ++i) {
    if (m.stages.size() == i) m.stages.emplace_back(run.stages[i].first, Samples{});
    m.stages[i].second.ms.push_back(run.stages[i].second);
    surfaces_ms += is_counterpart(run.stages[i].first) ? run.stages[i].second : 0;
  }
  m.surfaces.ms.push_back(surfaces_ms);
}

}  // namespace

double Samples::median() const {
  std::vector<double> sorted = ms;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t half = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[half] : 0.5 * (sorted[half - 1] + sorted[half]);
}

double Samples::min() const {
  return *std::min_element(ms.begin(), ms.end());
}

double Samples::max() const {
  return *std::max_element(ms.begin(), ms.end());
}

Measurement measure(const BenchCloud& bench, const BenchSettings& settings) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(settings.threads));
  tbb::task_arena arena(settings.threads);
  const auto run_baseline = [&] {
    return run_pcl(bench.cloud, settings.config.neighborhoods.radius_m,
                   settings.config.smoothness.theta_high_deg, settings.threads);
  };
  const DetectRun warm = run_detection(bench, settings, arena);
  (void)run_baseline();
  Measurement m;
  m.cloud = bench.name;
  m.points_in = bench.cloud.size();
  m.points_used = warm.detection.points_used;
  m.num_candidates = warm.detection.num_candidates;
  m.num_handles = warm.detection.handles.size();
  for (int round = 0; round < settings.rounds; ++round) {
    add(run_detection(bench, settings, arena), m);
    const PclTimes pcl = run_baseline();
    m.pcl.ms.push_back(pcl.total_ms());
    m.pcl_normals.ms.push_back(pcl.normals_ms);
    m.pcl_region_growing.ms.push_back(pcl.region_growing_ms);
    if (stop_requested()) break;
  }
  return m;
}

}  // namespace graspd

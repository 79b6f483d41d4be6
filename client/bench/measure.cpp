// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/bench/measure.hpp"

#include <string_view>

#include "client/bench/pcl_baseline.hpp"
#include "client/common/stop_flag.hpp"

namespace graspd {
namespace {

using Clock = std::chrono::steady_clock;

double ms_between(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double, std::milli>(to - from).count();
}

void add(const TimedDetection& run, BenchResult& result) {
  result.add_time(kWhole, run.total_ms);
  result.add_time(kSurfaces, run.surfaces_ms());
  for (const auto& [stage, ms] : run.stages_ms) result.add_time("stage " + stage, ms);
}

/// One more turn of PCL.
class Peer {
 public:
  Peer(const PointCloud& cloud, const DetectConfig& config, int threads)
      : cloud_(cloud), config_(config), threads_(threads) {}

  [[nodiscard]] PclTimes run() const {
    return run_pcl(cloud_, config_.neighborhoods.radius_m, config_.smoothness.theta_high_deg, threads_);
  }

  void run(BenchResult& result) const {
    const PclTimes times = run();
    result.add_time(kPcl, times.total_ms());
    result.add_time("pcl normals", times.normals_ms);
    result.add_time("pcl region_growing", times.region_growing_ms);
  }

 private:
  const PointCloud& cloud_;
  const DetectConfig& config_;
  int threads_;
};

void add_figures(const TimedDetection& run, BenchResult& result) {
  result.points_used = run.detection.points_used;
  result.figures = {{"handles", static_cast<double>(run.detection.handles.size())},
                    {"candidates", static_cast<double>(run.detection.num_candidates)}};
}

void add_ratios(BenchResult& result) {
  const double whole = result.find(kWhole)->median(), surfaces = result.find(kSurfaces)->median();
  result.figures.emplace_back("whole_ns_per_point", 1e6 * whole / result.points_used);
  result.figures.emplace_back("surfaces_ns_per_point", 1e6 * surfaces / result.points_used);
  const Samples* pcl = result.find(kPcl);
  if (!pcl || whole <= 0 || surfaces <= 0) return;
  result.figures.emplace_back("pcl_to_whole", pcl->median() / whole);
  result.figures.emplace_back("pcl_to_surfaces", pcl->median() / surfaces);
}

}  // namespace

double LapTimer::lap_ms() {
  const Clock::time_point now = Clock::now();
  return ms_between(std::exchange(last_, now), now);
}

double TimedDetection::surfaces_ms() const {
  double sum = 0;
  for (const auto& [stage, ms] : stages_ms)
    if (stage == "support" || stage == "neighborhoods" || stage == "normals" || stage == "edge_points" ||
        stage == "region_growing")
      sum += ms;
  return sum;
}

TimedDetection timed_detection(const PointCloud& cloud, const DetectConfig& config, tbb::task_arena& arena) {
  TimedDetection run;
  const auto start = Clock::now();
  LapTimer timer;
  arena.execute([&] {
    run.detection = detect_handles(cloud, Gripper{}, config, [&](std::string_view stage) {
      run.stages_ms.emplace_back(stage, timer.lap_ms());
    });
  });
  run.total_ms = ms_between(start, Clock::now());
  return run;
}

bool takes_part(int round, int rounds, int some) {
  if (some >= rounds) return true;
  // As often as the whole part of round * some / rounds grows.
  return (static_cast<long>(round) * some) / rounds != (static_cast<long>(round + 1) * some) / rounds;
}

BenchResult measure_in_turns(const std::string& suite, const BenchCloud& bench, const DetectConfig& config,
                             int threads, const BenchOptions& options) {
  ThreadLimit limit(threads);
  const DetectConfig plain = plain_config(config);
  const Peer peer(bench.cloud, config, threads);
  BenchResult result{suite, bench.name, threads, bench.cloud.size(), 0, {}, {}};
  add_figures(timed_detection(bench.cloud, config, limit.arena()), result);
  if (options.paper) (void)timed_detection(bench.cloud, plain, limit.arena());
  if (!options.no_pcl) (void)peer.run();
  for (int round = 0; round < options.rounds; ++round) {
    add(timed_detection(bench.cloud, config, limit.arena()), result);
    if (options.paper) result.add_time(kPlain, timed_detection(bench.cloud, plain, limit.arena()).total_ms);
    if (!options.no_pcl && takes_part(round, options.rounds, options.pcl_rounds)) peer.run(result);
    if (stop_requested()) break;
  }
  add_ratios(result);
  return result;
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Timing one detection, and graspd and its peer in turns.
#pragma once
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "client/bench/bench_clouds.hpp"
#include "client/bench/bench_result.hpp"
#include "service/pipeline/detect_handles.hpp"

namespace graspd {

/// Threads that graspd may use while it lives.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads)
      : limit_(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)),
        arena_(threads) {}
  [[nodiscard]] tbb::task_arena& arena() { return arena_; }

 private:
  tbb::global_control limit_;
  tbb::task_arena arena_;
};

/// Since the last call, or the construction [ms].
class LapTimer {
 public:
  double lap_ms();

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// One detection with the time of each stage.
struct TimedDetection {
  Detection detection;
  double total_ms = 0;
  std::vector<std::pair<std::string, double>> stages_ms;

  /// The stages that do what PCL is timed for; the support's points take no part in the others because it was
  /// found.
  [[nodiscard]] double surfaces_ms() const;
};
[[nodiscard]] TimedDetection timed_detection(const PointCloud& cloud, const DetectConfig& config,
                                             tbb::task_arena& arena);

/// graspd, with --paper its plain form, and PCL in turns, after one turn each that does not count. PCL takes
/// part in pcl_rounds of the rounds, spread evenly. Ends early when a stop was requested.
[[nodiscard]] BenchResult measure_in_turns(const std::string& suite, const BenchCloud& bench,
                                           const DetectConfig& config, int threads,
                                           const BenchOptions& options);

/// Whether PCL's turn comes in this round, when it has some of the rounds.
[[nodiscard]] bool takes_part(int round, int rounds, int some);

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What the benchmark found out: one result for each cloud, size or rate, and number of threads.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "client/bench/samples.hpp"

namespace graspd {

/// Names of series that several suites have.
inline constexpr std::string_view kWhole = "whole";        ///< graspd, cloud or bytes to the end
inline constexpr std::string_view kSurfaces = "surfaces";  ///< of that, what PCL is timed for
inline constexpr std::string_view kPlain = "plain";        ///< graspd with the paper's own candidates
inline constexpr std::string_view kPcl = "pcl";            ///< normals and region growing

struct TimeSeries {
  std::string name;
  Samples ms;
};

struct BenchResult {
  std::string suite;
  std::string name;  ///< of the cloud or the rate
  int threads = 0;   ///< 0: the daemon's own choice
  std::size_t points_in = 0;
  int points_used = 0;  ///< after downsampling; 0: not known
  std::vector<TimeSeries> times;
  std::vector<std::pair<std::string, double>> figures;  ///< what is no time; units in the names

  /// Adds the series when it is not there yet.
  void add_time(std::string_view series, double ms);
  /// Null where there is none.
  [[nodiscard]] const Samples* find(std::string_view series) const;
};

/// A suite that could not be measured.
struct SkippedSuite {
  std::string suite, reason;
};

struct BenchRun {
  std::vector<BenchResult> results;
  std::vector<SkippedSuite> skipped;
};

}  // namespace graspd

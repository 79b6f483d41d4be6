// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Times detection and PCL on one cloud in turns, so that whatever else the machine does meets both.
#pragma once
#include <string>
#include <vector>

#include "service/pipeline/detect_config.hpp"
#include "service/pipeline/gripper.hpp"
#include "tests/benchmark/bench_clouds.hpp"

namespace graspd {

struct Samples {
  std::vector<double> ms;

  [[nodiscard]] double median() const;
  [[nodiscard]] double min() const;
  [[nodiscard]] double max() const;
};

struct Measurement {
  std::string cloud;
  std::size_t points_in = 0;
  int points_used = 0;
  int num_candidates = 0;
  std::size_t num_handles = 0;
  Samples detect;                                       ///< the whole of detect_handles
  std::vector<std::pair<std::string, Samples>> stages;  ///< of it, in order
  Samples surfaces;  ///< of it, what PCL is timed for: support to region growing
  Samples pcl;       ///< normals and region growing
  Samples pcl_normals, pcl_region_growing;
};

struct BenchSettings {
  int threads = 2;
  int rounds = 20;
  Gripper gripper;
  DetectConfig config;
};

/// One round of both to warm up, then the rounds; fewer when a stop is requested.
[[nodiscard]] Measurement measure(const BenchCloud& bench, const BenchSettings& settings);

}  // namespace graspd

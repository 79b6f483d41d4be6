// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What graspd-bench is asked for.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "service/pipeline/detect_config.hpp"

namespace graspd {

struct BenchOptions {
  std::vector<std::string> suites;
  std::vector<std::string> inputs;  ///< files and folders; empty: simulated scenes
  std::string scene = "medium";
  std::uint64_t seed = 1;
  int scenes = 2;   ///< simulated ones
  int width = 640;  ///< of their images; the height is 3/4 of it [pixels]
  float leaf_m = 0.0045f;
  std::vector<std::int64_t> points;  ///< sizes of the suite points; empty: its own
  std::vector<int> threads;          ///< empty: as the suite has it
  int rounds = 20;
  int pcl_rounds = 5;
  bool no_pcl = false;
  bool paper = false;
  bool full = false;
  std::vector<double> rates_hz = {30};
  double seconds = 5;
  int hogs = 0;                ///< processes beside the daemon that never sleep
  std::string daemon_program;  ///< empty: graspd beside this program
  std::string daemon_config;
  std::string json_file, plot_file;
};

/// Why the options do not go together.
[[nodiscard]] std::optional<std::string> problem(const BenchOptions& options);

/// Those to run, in their order, each once; without any given a quick choice.
[[nodiscard]] std::vector<std::string> suites_to_run(const BenchOptions& options);
[[nodiscard]] std::vector<std::string> suite_names();  ///< all among them

/// Sizes of the suite points.
[[nodiscard]] std::vector<std::int64_t> point_counts(const BenchOptions& options);

/// 1, 2, 3, 4 and from there on doubled up to all.
[[nodiscard]] std::vector<int> thread_counts(const BenchOptions& options, int all);
/// One and all.
[[nodiscard]] std::vector<int> outer_thread_counts(const BenchOptions& options, int all);

/// The default configuration at another resolution: the radius stays three voxels.
[[nodiscard]] DetectConfig config_at(float leaf_m);

/// The paper's own candidates as far as the configuration goes: bands without seeds, no support, no
/// container, and the checks that the paper does not have as wide open as they go.
[[nodiscard]] DetectConfig plain_config(DetectConfig config);

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// graspd-replay LOG... -o OUT: logs in, log out.
#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "client/replay/reading.hpp"

namespace graspd {

struct RunOptions {
  std::vector<std::string> logs;
  std::string output;
  std::string config;
  std::string gripper;
  std::string key_file;
  std::string keep;
  std::string from;
  std::string to;
  std::string frames;
  PlaceOptions places;
  std::string table;
  int threads = 0;
  double checkpoint_s = 1;
  bool resume = false;
  bool overwrite = false;
  bool times = false;
};

void add_run_options(CLI::App& app, RunOptions& options);
[[nodiscard]] int run_command(const CLI::App& app, const RunOptions& options);

/// Threads to work with, at least one; 0: one a core.
[[nodiscard]] int replay_threads(int wanted);

}  // namespace graspd

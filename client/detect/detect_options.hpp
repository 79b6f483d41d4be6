// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The options by which programs that detect in files take the daemon's settings.
#pragma once
#include <string>

#include "service/config/source_config.hpp"

namespace CLI {
class App;
}

namespace graspd {

struct DetectOptions {
  std::string config;
  std::string source;
  std::string gripper;
  std::string sensor;
  int threads = 0;
};

/// Adds --config, --source, --gripper, --sensor and --threads.
void add_detect_options(CLI::App& app, DetectOptions& options);

/// The settings of the daemon's source that the options name. Throws ConfigError.
[[nodiscard]] SourceConfig source_config(const DetectOptions& options);

/// Threads to work with, at least one.
[[nodiscard]] int thread_count(const DetectOptions& options);

}  // namespace graspd

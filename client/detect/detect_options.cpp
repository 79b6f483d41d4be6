// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/detect/detect_options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <thread>

#include "service/config/service_config.hpp"

namespace graspd {

void add_detect_options(CLI::App& app, DetectOptions& o) {
  auto* config = app.add_option("--config", o.config, "the daemon's configuration (default: its defaults)");
  app.add_option("--source", o.source, "which of the configuration's sources (default: the first)")
      ->needs(config);
  app.add_option("--gripper", o.gripper,
                 "name of an installed gripper, or a gripper file (default: the source's)");
  app.add_option("--sensor", o.sensor,
                 "name of an installed sensor, or a sensor file (default: the source's)");
  app.add_option("--threads", o.threads, "threads to work with; 0: one a core")
      ->check(CLI::Range(0, 256))
      ->capture_default_str();
}

SourceConfig source_config(const DetectOptions& o) {
  const std::filesystem::path file = o.config;
  ServiceConfig config;
  if (!file.empty()) config = load_service_config(file);
  SourceConfig source = config.sources.front();
  if (!o.source.empty()) {
    const auto named = std::find_if(config.sources.begin(), config.sources.end(),
                                    [&](const SourceConfig& s) { return s.name == o.source; });
    if (named == config.sources.end())
      throw ConfigError(o.config + ": sources: none has the name " + o.source);
    source = *named;
  }
  if (!o.gripper.empty()) source.gripper = find_gripper(o.gripper, std::filesystem::current_path());
  if (!o.sensor.empty()) {
    const Eigen::Isometry3f T_box_cloud = source.detect.workspace.T_box_cloud;
    source.detect = load_detect_config(file, o.sensor);
    source.detect.workspace.T_box_cloud = T_box_cloud;
  }
  return source;
}

int thread_count(const DetectOptions& o) {
  return o.threads > 0 ? o.threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

}  // namespace graspd

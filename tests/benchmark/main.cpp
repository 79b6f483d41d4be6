// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// graspd-bench-detect: how long detection takes from a decoded cloud to handles, with PCL beside it.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "client/common/program.hpp"
#include "client/common/stop_flag.hpp"
#include "tests/benchmark/bench_report.hpp"

namespace graspd {
namespace {

struct Options {
  std::vector<std::string> inputs;
  float leaf_m = 0.0045f;
  float radius_m = 0;
  int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  int rounds = 20;
  bool full = false;
  std::string json_file;
};

void add_options(CLI::App& app, Options& options) {
  app.add_option("files", options.inputs, "PCD or PLY files, or folders of them; without: a scene made here");
  app.add_option("--leaf", options.leaf_m, "edge of the voxels [m]")
      ->check(CLI::Range(0.0005, 0.1))
      ->capture_default_str();
  app.add_option("--radius", options.radius_m, "of the neighbourhoods [m]; default: three voxels")
      ->check(CLI::Range(0.001, 0.3));
  app.add_option("--threads", options.threads, "for both")->check(CLI::Range(1, 256))->capture_default_str();
  app.add_option("--rounds", options.rounds, "both in turns, this often")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  app.add_flag("--full", options.full, "hand over every point; the voxels are then made within the time");
  app.add_option("--json", options.json_file, "write the figures to this file, too");
}

void write_json(const std::string& path, const std::string& text) {
  std::ofstream file(path);
  file << text << std::flush;
  if (!file) throw std::runtime_error(path + ": cannot be written");
}

int run(const Options& options) {
  BenchSettings settings;
  settings.threads = options.threads;
  settings.rounds = options.rounds;
  settings.config.downsample.leaf_size_m = options.leaf_m;
  settings.config.neighborhoods.radius_m = options.radius_m > 0 ? options.radius_m : 3 * options.leaf_m;
  if (const auto problem = settings.config.validate())
    throw std::runtime_error(problem->key + ": " + problem->reason);
  std::vector<Measurement> measurements;
  for (const BenchCloud& bench : bench_clouds(options.inputs, options.full ? 0 : options.leaf_m)) {
    measurements.push_back(measure(bench, settings));
    write_output(table(measurements.back(), settings) + "\n");
    if (stop_requested()) break;
  }
  write_output(summary(measurements));
  if (!options.json_file.empty()) write_json(options.json_file, json(measurements, settings));
  return kExitOk;
}

}  // namespace
}  // namespace graspd

int main(int argc, char** argv) {
  CLI::App app(
      "Times graspd's detection, from a decoded cloud to handles, and PCL's normals and region growing on "
      "the same cloud.",
      "graspd-bench-detect");
  graspd::Options options;
  graspd::add_options(app, options);
  return graspd::run_program(app, argc, argv, [&] { return graspd::run(options); });
}

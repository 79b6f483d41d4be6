// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// graspd-bench: how long graspd takes, with PCL beside it in the same run.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "client/bench/bench_report.hpp"
#include "client/bench/suites.hpp"
#include "client/common/program.hpp"
#include "client/simulate/scene_builder.hpp"
#include "service/runtime/kept_memory.hpp"

namespace graspd {
namespace {

void add_input_options(CLI::App& app, BenchOptions& o) {
  app.add_option("files", o.inputs,
                 "stages: PCD or PLY files, or folders of them; without: simulated scenes");
  app.add_option("--scene", o.scene, "what the simulated camera looks at")
      ->check(CLI::IsMember(scene_kind_names()))
      ->capture_default_str();
  app.add_option("--scenes", o.scenes, "how many scenes")->check(CLI::Range(1, 1000))->capture_default_str();
  app.add_option("--seed", o.seed, "of the simulated scenes")->capture_default_str();
  app.add_option("--width", o.width, "of the camera's images; the height is 3/4 of it [pixels]")
      ->check(CLI::Range(64, 4096))
      ->capture_default_str();
  app.add_option("--leaf", o.leaf_m, "stages: edge of the voxels [m]; the radius is three of them")
      ->check(CLI::Range(0.0005, 0.1))
      ->capture_default_str();
  app.add_flag("--full", o.full, "stages: hand over every point; the voxels are made within the time");
  app.add_option("--points", o.points, "points: sizes of the clouds")
      ->delimiter(',')
      ->check(CLI::Range(500, 4000000));
}

void add_options(CLI::App& app, BenchOptions& o) {
  add_version(app);
  app.add_option("-s,--suite", o.suites, "what is measured; without: stages, some points, codec")
      ->delimiter(',')
      ->check(CLI::IsMember(suite_names()));
  add_input_options(app, o);
  app.add_option("--threads", o.threads, "numbers of threads; without: 1, 2, ... all, or 1 and all")
      ->delimiter(',')
      ->check(CLI::Range(1, 256));
  app.add_option("--rounds", o.rounds, "all in turns, this often")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  app.add_option("--pcl-rounds", o.pcl_rounds, "PCL takes part in so many of the rounds")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  app.add_flag("--no-pcl", o.no_pcl, "leave PCL out");
  app.add_flag("--paper", o.paper,
               "beside the default configuration a plain one: the paper's bands alone, without support, "
               "seeds and further checks");
  app.add_option("--rate", o.rates_hz, "lcm: frames a second, one run for each")
      ->delimiter(',')
      ->check(CLI::Range(0.1, 1000.0))
      ->capture_default_str();
  app.add_option("--seconds", o.seconds, "lcm: length of a run")
      ->check(CLI::Range(0.1, 3600.0))
      ->capture_default_str();
  app.add_option("--hog", o.hogs, "lcm: beside so many processes that never sleep, each on a core of its own")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  app.add_option("--graspd", o.daemon_program, "lcm: the daemon (default: the one beside this program)")
      ->check(CLI::ExistingFile);
  app.add_option("--config", o.daemon_config, "lcm: the daemon's configuration")->check(CLI::ExistingFile);
  app.add_option("--json", o.json_file, "write the figures to this file, too");
  app.add_option("--plot", o.plot_file, "points: draw time against points into this SVG file");
  app.callback([&o] {
    if (const auto text = problem(o)) throw CLI::ValidationError(*text);
  });
}

void write_file(const std::string& path, const std::string& text) {
  std::ofstream file(path);
  file << text << std::flush;
  if (!file) throw std::runtime_error(path + ": cannot be written");
}

int run(const CLI::App& app, const BenchOptions& options) {
  const BenchRun bench =
      run_suites(options, [](const BenchResult& result) { write_output(result_table(result)); });
  for (const auto& [suite, reason] : bench.skipped) say(app, suite + ": not measured: " + reason);
  if (!options.json_file.empty()) write_file(options.json_file, bench_json(bench, options));
  if (!options.plot_file.empty()) write_file(options.plot_file, svg(cost_plot(bench)));
  return bench.skipped.empty() ? kExitOk : kExitFailed;
}

}  // namespace
}  // namespace graspd

int main(int argc, char** argv) {
  graspd::keep_memory();  // as the daemon does
  CLI::App app("Times graspd, from clouds, messages or the bus to handles, and PCL on the same clouds.",
               "graspd-bench");
  graspd::BenchOptions options;
  graspd::add_options(app, options);
  return graspd::run_program(app, argc, argv, [&] { return graspd::run(app, options); });
}

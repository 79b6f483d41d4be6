// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/simulate_mode.hpp"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <numbers>

#include "client/common/text.hpp"

namespace graspd {
namespace {

std::vector<JudgedFrame> frames_of(const std::vector<JudgedScene>& scenes) {
  std::vector<JudgedFrame> frames;
  for (const JudgedScene& scene : scenes) frames.push_back(scene.frame);
  return frames;
}

Progress progress_of(std::int64_t all) {
  if (isatty(STDERR_FILENO) == 0) return {};
  return [all](std::int64_t done) {
    std::fprintf(stderr, "\r%lld of %lld scenes%s", static_cast<long long>(done), static_cast<long long>(all),
                 done == all ? "\n" : "");
  };
}

std::vector<JudgedScene> run(const SimulateOptions& o, const Gripper& gripper, const DetectConfig& config,
                             const HandlesOfFrame& handles) {
  return judge_scenes(simulation_config(o), o.scenes, gripper, handles ? handles : detector(gripper, config),
                      o.kind, progress_of(o.scenes.num));
}

std::vector<Table> aperture_tables(const SimulateOptions& o, const Gripper& gripper,
                                   const DetectConfig& config) {
  std::vector<NamedRun> runs;
  for (const float aperture_m : o.apertures_m) {
    Gripper other = gripper;
    other.aperture_m = aperture_m;
    runs.push_back({printed("d = %.0f mm", 1e3 * double{aperture_m}), frames_of(run(o, other, config, {}))});
  }
  return {figures_table(runs)};
}

std::vector<Table> stability_tables(const SimulateOptions& o, const Gripper& gripper,
                                    const DetectConfig& config) {
  std::vector<ObjectStability> objects;
  SimulationConfig simulation = simulation_config(o);
  for (std::int64_t i = 0; i < o.scenes.num; ++i) {
    simulation.seed = o.seed + static_cast<std::uint64_t>(o.scenes.first + i);
    const auto found = pose_stability(simulation, o.stability, detector(gripper, config));
    objects.insert(objects.end(), found.begin(), found.end());
  }
  return {stability_table(objects, o.stability)};
}

}  // namespace

void add_simulate_options(CLI::App& app, SimulateOptions& o) {
  const std::string group = "Simulated scenes";
  auto* simulate =
      app.add_option("--simulate", o.kind, "judge on the true solids of simulated scenes of this kind")
          ->check(CLI::IsMember(scene_kind_names()))
          ->group(group);
  app.add_option("--noise", o.noise, "of which sensor")
      ->check(CLI::IsMember({"ideal", "kinect", "realsense"}))
      ->needs(simulate)
      ->capture_default_str()
      ->group(group);
  app.add_option("--seed", o.seed, "frames are those of graspd-simulate --new-scene-every 1 --seed SEED")
      ->needs(simulate)
      ->capture_default_str()
      ->group(group);
  app.add_option("--scenes", o.scenes.num, "how many")
      ->check(CLI::Range(1, 100000))
      ->needs(simulate)
      ->capture_default_str()
      ->group(group);
  app.add_option("--first-scene", o.scenes.first, "number of the first one")
      ->check(CLI::NonNegativeNumber)
      ->needs(simulate)
      ->capture_default_str()
      ->group(group);
  app.add_flag("--list", o.list, "every handle that does not hold and every object missed, with poses")
      ->needs(simulate)
      ->group(group);
  auto* apertures = app.add_option("--apertures", o.apertures_m,
                                   "a run for each of these apertures d [m], other lengths kept")
                        ->delimiter(',')
                        ->check(CLI::Range(0.005, 0.5))
                        ->needs(simulate)
                        ->group(group);
  app.add_option(
         "--stability", o.stability,
         "instead: how far the best handle of each object moves over so many noisy frames of one scene")
      ->check(CLI::Range(2, 100000))
      ->needs(simulate)
      ->excludes(apertures)
      ->group(group);
}

SimulationConfig simulation_config(const SimulateOptions& o) {
  SimulationConfig config;
  config.scene.kind = *scene_kind(o.kind);
  config.sensor = *sensor_model(o.noise);
  config.seed = o.seed;
  config.new_scene_every = 1;
  config.elevation_rad = usual_elevation_deg(config.scene.kind) * std::numbers::pi / 180;
  return config;
}

std::vector<Table> simulate_tables(const SimulateOptions& o, const Gripper& gripper,
                                   const DetectConfig& config, const HandlesOfFrame& handles) {
  if (o.stability > 0) return stability_tables(o, gripper, config);
  if (!o.apertures_m.empty()) return aperture_tables(o, gripper, config);
  const auto scenes = run(o, gripper, config, handles);
  const auto frames = frames_of(scenes);
  constexpr std::size_t kWorst = 10;
  std::vector<Table> tables{figures_table(std::vector{NamedRun{o.kind, frames}}), failure_table(frames),
                            kind_table(scenes), calibration_table(frames), worst_scene_table(scenes, kWorst)};
  if (o.list) {
    tables.push_back(failed_handle_table(scenes));
    tables.push_back(missed_object_table(scenes));
  }
  return tables;
}

}  // namespace graspd

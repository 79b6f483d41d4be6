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
  frames.reserve(scenes.size());
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

std::vector<Table> stability_tables(const SimulateOptions& o, const HandlesOfFrame& handles) {
  std::vector<ObjectStability> objects;
  SimulationConfig simulation = simulation_config(o);
  for (std::int64_t i = 0; i < o.scenes.num; ++i) {
    simulation.seed = o.seed + static_cast<std::uint64_t>(o.scenes.first + i);
    const auto found = pose_stability(simulation, o.stability, handles);
    objects.insert(objects.end(), found.begin(), found.end());
  }
  return {stability_table(objects, o.stability)};
}

/// Frames count as frames without handles when a file does not name them; that must not go unseen.
Table unnamed_frame_table(const std::vector<JudgedScene>& scenes) {
  Table table{"unnamed", "Frames that the file of handles does not name", {"frame"}, {}};
  for (const JudgedScene& scene : scenes)
    if (!scene.has_list) table.rows.push_back({scene.frame.name});
  return table;
}

std::vector<Table> details(const std::vector<JudgedScene>& scenes, const SimulateTables& wanted) {
  constexpr std::size_t kWorst = 10;
  const auto frames = frames_of(scenes);
  std::vector<Table> tables{failure_table(frames), kind_table(scenes), worst_scene_table(scenes, kWorst)};
  if (Table unnamed = unnamed_frame_table(scenes); !unnamed.rows.empty())
    tables.push_back(std::move(unnamed));
  if (wanted.disturb) tables.push_back(scene_steadiness_table(scenes));
  if (wanted.calibration) tables.push_back(calibration_table(frames));
  if (wanted.explain) {
    tables.push_back(failed_handle_table(scenes));
    tables.push_back(missed_object_table(scenes));
  }
  return tables;
}

}  // namespace

CLI::Option* add_simulate_options(CLI::App& app, SimulateOptions& o) {
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
  app.add_option("--distance", o.distance_m, "from the camera to the middle of the scene [m]")
      ->check(CLI::Range(0.3, 3.0))
      ->needs(simulate)
      ->capture_default_str()
      ->group(group);
  app.add_option("--elevation", o.elevation_deg,
                 "of the camera above the horizon [degrees] (default: 43, over a bin 63, before a shelf 30)")
      ->check(CLI::Range(5.0, 90.0))
      ->needs(simulate)
      ->group(group);
  app.add_option("--first-scene", o.scenes.first, "number of the first one")
      ->check(CLI::NonNegativeNumber)
      ->needs(simulate)
      ->capture_default_str()
      ->group(group);
  app.add_option(
         "--stability", o.stability,
         "instead: how far the best handle of each object moves over so many noisy frames of one scene")
      ->check(CLI::Range(2, 100000))
      ->needs(simulate)
      ->group(group);
  return simulate;
}

SimulationConfig simulation_config(const SimulateOptions& o) {
  SimulationConfig config;
  config.scene.kind = *scene_kind(o.kind);
  config.sensor = *sensor_model(o.noise);
  config.seed = o.seed;
  config.new_scene_every = 1;
  config.distance_m = o.distance_m;
  config.elevation_rad =
      o.elevation_deg.value_or(usual_elevation_deg(config.scene.kind)) * std::numbers::pi / 180;
  return config;
}

std::vector<Table> simulate_tables(const SimulateOptions& o, const std::vector<EvaluatedRun>& runs,
                                   const Eigen::Isometry3f& T_cloud_handles, const SimulateTables& wanted) {
  if (o.stability > 0) return stability_tables(o, handle_source(runs.front(), T_cloud_handles));
  std::vector<NamedRun> judged;
  std::vector<JudgedScene> first;
  for (const EvaluatedRun& run : runs) {
    auto scenes = judge_scenes(simulation_config(o), o.scenes, run.gripper,
                               handle_source(run, T_cloud_handles), o.kind, progress_of(o.scenes.num));
    judged.push_back({run.name, frames_of(scenes)});
    if (judged.size() == 1) first = std::move(scenes);
  }
  std::vector<Table> tables{figures_table(judged)};
  for (Table& table : details(first, wanted)) tables.push_back(std::move(table));
  return tables;
}

}  // namespace graspd

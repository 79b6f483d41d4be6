// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// graspd-evaluate --simulate: the options of runs over simulated scenes, and their tables.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "client/evaluate/scene_runs.hpp"
#include "client/evaluate/tables.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace graspd {

struct SimulateOptions {
  std::string kind;  ///< of the scenes; empty: no simulation
  std::string noise = "kinect";
  double distance_m = SimulationConfig{}.distance_m;
  std::optional<double> elevation_deg;  ///< nothing: the usual one of the kind
  std::uint64_t seed = 1;
  SceneRange scenes;
  std::int64_t stability = 0;

  [[nodiscard]] bool given() const { return !kind.empty(); }
};

/// Adds --simulate and what belongs to it; returns --simulate.
CLI::Option* add_simulate_options(CLI::App& app, SimulateOptions& options);

/// The frames of graspd-simulate --scene KIND --sensor NOISE --seed SEED --new-scene-every 1.
[[nodiscard]] SimulationConfig simulation_config(const SimulateOptions& options);

/// What to show besides the figures.
struct SimulateTables {
  bool calibration = false;
  bool disturb = false;
  bool explain = false;
};

/// Figures of every run, details of the first. T_cloud_handles takes handles of files into the camera's
/// frame.
[[nodiscard]] std::vector<Table> simulate_tables(const SimulateOptions& options,
                                                 const std::vector<EvaluatedRun>& runs,
                                                 const Eigen::Isometry3f& T_cloud_handles,
                                                 const SimulateTables& wanted);

}  // namespace graspd

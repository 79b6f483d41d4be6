// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// graspd-evaluate --simulate: the options of runs over simulated scenes, and their tables.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "client/evaluate/scene_runs.hpp"
#include "client/evaluate/tables.hpp"

namespace CLI {
class App;
}

namespace graspd {

struct SimulateOptions {
  std::string kind;  ///< empty: no simulation
  std::string noise = "kinect";
  std::uint64_t seed = 1;
  SceneRange scenes;
  std::int64_t stability = 0;
  std::vector<float> apertures_m;
  bool list = false;
};

void add_simulate_options(CLI::App& app, SimulateOptions& options);

/// The frames of graspd-simulate --scene KIND --sensor NOISE --seed SEED --new-scene-every 1.
[[nodiscard]] SimulationConfig simulation_config(const SimulateOptions& options);

/// What the options ask for. handles: where they come from; empty: the method with these settings.
[[nodiscard]] std::vector<Table> simulate_tables(const SimulateOptions& options, const Gripper& gripper,
                                                 const DetectConfig& config,
                                                 const HandlesOfFrame& handles = {});

}  // namespace graspd

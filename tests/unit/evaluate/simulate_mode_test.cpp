// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/simulate_mode.hpp"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <numbers>
#include <string>

namespace graspd {
namespace {

SimulateOptions parsed(const std::string& arguments) {
  CLI::App app;
  SimulateOptions options;
  add_simulate_options(app, options);
  app.parse(arguments);
  return options;
}

double degrees(double radians) {
  return radians * 180 / std::numbers::pi;
}

TEST(SimulateOptions, TheViewIsThatOfGraspdSimulate) {
  const SimulationConfig table = simulation_config(parsed("--simulate table"));
  EXPECT_DOUBLE_EQ(table.distance_m, 0.85);
  EXPECT_NEAR(degrees(table.elevation_rad), usual_elevation_deg(SceneKind::kTable), 1e-9);
  const SimulationConfig bin = simulation_config(parsed("--simulate bin"));
  EXPECT_NEAR(degrees(bin.elevation_rad), usual_elevation_deg(SceneKind::kBin), 1e-9);
  EXPECT_GT(bin.elevation_rad, table.elevation_rad);
}

TEST(SimulateOptions, AnotherView) {
  const SimulationConfig config =
      simulation_config(parsed("--simulate bin --distance 1.1 --elevation 30 --noise realsense"));
  EXPECT_DOUBLE_EQ(config.distance_m, 1.1);
  EXPECT_NEAR(degrees(config.elevation_rad), 30, 1e-9);
}

TEST(SimulateOptions, RefusesAViewOfNothing) {
  EXPECT_THROW(parsed("--distance 1.1"), CLI::ParseError);
  EXPECT_THROW(parsed("--simulate table --distance 0.1"), CLI::ParseError);
  EXPECT_THROW(parsed("--simulate table --elevation 91"), CLI::ParseError);
}

}  // namespace
}  // namespace graspd

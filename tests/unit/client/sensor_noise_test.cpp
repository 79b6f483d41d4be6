// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/simulate/sensor_noise.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "client/simulate/simulation.hpp"

namespace graspd {
namespace {

/// A wall across the optical axis; right of the column it is nearer.
DepthFrame walls(float far_m, float near_m, int column) {
  DepthFrame frame;
  const std::size_t n = 640 * 480;
  frame.depth_m.assign(n, far_m);
  frame.label.assign(n, 1);
  frame.rgb.assign(n, 0);
  frame.cos_incidence.assign(n, 1);
  for (std::size_t i = 0; i < n; ++i) {
    if (static_cast<int>(i % 640) < column) continue;
    frame.depth_m[i] = near_m;
    frame.label[i] = 20;
  }
  return frame;
}

DepthFrame wall(float z) {
  return walls(z, z, 640);
}

double deviation(const DepthFrame& frame, double z) {
  double sum = 0;
  for (const float depth : frame.depth_m) sum += (double(depth) - z) * (double(depth) - z);
  return std::sqrt(sum / static_cast<double>(frame.size()));
}

TEST(SensorNoise, IdealChangesNothing) {
  const DepthFrame ideal = walls(1.0f, 0.8f, 300);
  const DepthFrame frame = apply_sensor(ideal, *sensor_model("ideal"), 1);
  EXPECT_EQ(frame.depth_m, ideal.depth_m);
  EXPECT_EQ(frame.label, ideal.label);
}

TEST(SensorNoise, UnknownSensorsAreRefused) {
  EXPECT_FALSE(sensor_model("lidar"));
}

TEST(SensorNoise, TheSeedDecidesToTheBit) {
  for (const char* name : {"kinect", "realsense"}) {
    const DepthFrame ideal = walls(1.0f, 0.8f, 300);
    const DepthFrame a = apply_sensor(ideal, *sensor_model(name), 1);
    EXPECT_EQ(a.depth_m, apply_sensor(ideal, *sensor_model(name), 1).depth_m);
    EXPECT_NE(a.depth_m, apply_sensor(ideal, *sensor_model(name), 2).depth_m);
  }
}

TEST(SensorNoise, GrowsWithTheSquareOfDepth) {
  SensorModel model;
  model.noise_constant_m = 0.0012;
  model.noise_quadratic_per_m = 0.0019;
  model.noise_offset_m = 0.4;
  for (const float z : {0.5f, 1.0f, 2.0f}) {
    const double expected = 0.0012 + 0.0019 * (double(z) - 0.4) * (double(z) - 0.4);
    EXPECT_NEAR(deviation(apply_sensor(wall(z), model, 3), double(z)), expected, 0.02 * expected);
    model.noise_patch_px = 4;
    EXPECT_NEAR(deviation(apply_sensor(wall(z), model, 3), double(z)), expected, 0.05 * expected);
    model.noise_patch_px = 1;
  }
}

TEST(SensorNoise, StepsAreEqualInInverseDepth) {
  SensorModel model = *sensor_model("kinect");
  model.flying = model.dropout = 0;
  const DepthFrame frame = apply_sensor(wall(1.5f), model, 4);
  for (const float z : frame.depth_m) {
    const double steps = 1 / (double(z) * model.quantum_per_m);
    EXPECT_NEAR(steps, std::round(steps), 1e-3);
  }
}

TEST(SensorNoise, DropsTheShareThatWasAskedFor) {
  SensorModel model;
  model.dropout = 0.1;
  const DepthFrame frame = apply_sensor(wall(1.0f), model, 5);
  int lost = 0;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    EXPECT_EQ(frame.depth_m[i] == 0, frame.label[i] == kLabelInvalid);
    lost += frame.depth_m[i] == 0;
  }
  EXPECT_NEAR(lost / 307200.0, 0.1, 0.005);
}

TEST(SensorNoise, GrazingSurfacesAreLost) {
  SensorModel model;
  model.grazing_cos = 0.2;
  const auto lost = [&](float cosine) {
    DepthFrame ideal = wall(1.0f);
    ideal.cos_incidence.assign(ideal.size(), cosine);
    const DepthFrame frame = apply_sensor(ideal, model, 6);
    return static_cast<double>(std::count(frame.depth_m.begin(), frame.depth_m.end(), 0.0f)) / 307200.0;
  };
  EXPECT_EQ(lost(0.19f), 1.0);
  EXPECT_NEAR(lost(0.3f), 0.5, 0.01);
  EXPECT_EQ(lost(0.41f), 0.0);
}

TEST(SensorNoise, FlyingPixelsHangBetweenBothSidesOfAnEdge) {
  SensorModel model;
  model.flying = 0.5;
  const DepthFrame frame = apply_sensor(walls(1.0f, 0.8f, 300), model, 7);
  int flying = 0;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const int u = static_cast<int>(i % 640);
    if (frame.depth_m[i] == (u < 300 ? 1.0f : 0.8f)) continue;
    EXPECT_TRUE(u == 299 || u == 300) << u;
    EXPECT_GT(frame.depth_m[i], 0.8f);
    EXPECT_LT(frame.depth_m[i], 1.0f);
    EXPECT_EQ(frame.label[i], kLabelInvalid);
    ++flying;
  }
  EXPECT_NEAR(flying, 480, 80);
}

TEST(SensorNoise, ShadowsAreAsWideAsTheDisparityDiffers) {
  SensorModel model;
  model.shadow_baseline_m = 0.075;
  const DepthFrame frame = apply_sensor(walls(1.0f, 0.8f, 300), model, 8);
  const double width = 525 * 0.075 * (1 / 0.8 - 1 / 1.0);
  int lost = 0;
  for (int u = 0; u < 640; ++u) lost += frame.depth_m[static_cast<std::size_t>(240 * 640 + u)] == 0;
  EXPECT_NEAR(lost, width, 1.5);
  EXPECT_EQ(frame.depth_m[240 * 640 + 300], 0.8f) << "what is in front casts it, and keeps its own";
  EXPECT_EQ(frame.depth_m[240 * 640 + 298], 0.0f) << "behind, on the far side from the other eye";
}

TEST(SensorNoise, OutOfRangeIsLost) {
  SensorModel model;
  model.min_range_m = 0.4;
  model.max_range_m = 4;
  EXPECT_EQ(apply_sensor(wall(0.3f), model, 9).depth_m[0], 0);
  EXPECT_EQ(apply_sensor(wall(5.0f), model, 9).depth_m[0], 0);
  EXPECT_EQ(apply_sensor(wall(2.0f), model, 9).depth_m[0], 2.0f);
}

SimulationConfig small_simulation() {
  SimulationConfig config;
  config.sensor = *sensor_model("kinect");
  config.camera = {160, 120, 131.25, 131.25, 79.5, 59.5};
  config.seed = 11;
  return config;
}

TEST(Simulation, AFrameDependsOnItsNumberAlone) {
  SimulationConfig config = small_simulation();
  config.new_scene_every = 3;
  config.orbit_rad_per_frame = 0.02;
  Simulation forward(config);
  Simulation backward(config);
  std::vector<DepthFrame> frames;
  for (int k = 0; k < 7; ++k) frames.push_back(forward.frame(k));
  for (int k = 6; k >= 0; --k) {
    const DepthFrame frame = backward.frame(k);
    EXPECT_EQ(frame.depth_m, frames[static_cast<std::size_t>(k)].depth_m) << k;
    EXPECT_EQ(frame.label, frames[static_cast<std::size_t>(k)].label) << k;
  }
}

TEST(Simulation, AStandingCameraSeesTheSameSceneWithFreshNoise) {
  Simulation simulation(small_simulation());
  const DepthFrame a = simulation.frame(0);
  const DepthFrame b = simulation.frame(1);
  EXPECT_NE(a.depth_m, b.depth_m);
  EXPECT_EQ(a.rgb, b.rgb);
}

TEST(Simulation, ANewSceneComesWhenItShould) {
  SimulationConfig config = small_simulation();
  config.new_scene_every = 2;
  Simulation simulation(config);
  const auto first = simulation.frame(0).rgb;
  EXPECT_EQ(simulation.frame(1).rgb, first);
  EXPECT_NE(simulation.frame(2).rgb, first);
}

}  // namespace
}  // namespace graspd

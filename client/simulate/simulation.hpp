// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// A simulated camera over time: which scene, seen from where, frame by frame.
#pragma once
#include <cstdint>

#include "client/simulate/depth_camera.hpp"
#include "client/simulate/scene_builder.hpp"
#include "client/simulate/sensor_noise.hpp"

namespace graspd {

/// Everything that decides what a frame looks like.
struct SimulationConfig {
  SceneConfig scene;
  SensorModel sensor;
  Pinhole camera;
  std::uint64_t seed = 1;
  int new_scene_every = 0;         ///< frames; 0: one scene for ever
  double distance_m = 0.85;        ///< from the camera to the middle of the scene
  double elevation_rad = 0.75;     ///< above the horizon
  double azimuth_rad = 0;          ///< around the scene
  double orbit_rad_per_frame = 0;  ///< the camera's own motion
};

/// The same view in another resolution; the height is 3/4 of the width.
[[nodiscard]] Pinhole scaled(const Pinhole& camera, int width);

/// Frame k depends on the configuration and k alone, to the bit.
class Simulation {
 public:
  explicit Simulation(const SimulationConfig& config) : config_(config) {}

  [[nodiscard]] DepthFrame frame(std::int64_t k);

  /// Of the last frame.
  [[nodiscard]] const Scene& scene() const { return scene_; }
  /// The last frame without the sensor's noise.
  [[nodiscard]] const DepthFrame& ideal() const { return ideal_; }
  [[nodiscard]] Eigen::Isometry3d T_world_camera(std::int64_t k) const;

 private:
  SimulationConfig config_;
  std::int64_t scene_number_ = -1;
  Scene scene_;
  DepthFrame ideal_;  // kept while scene and camera stand still
  std::int64_t ideal_of_ = -1;
};

}  // namespace graspd

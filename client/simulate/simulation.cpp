// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/simulate/simulation.hpp"

#include <cmath>
#include <numbers>

#include "client/simulate/rng.hpp"

namespace graspd {
namespace {

/// What the seed is used for.
enum class Purpose : std::uint64_t { kScene = 1, kNoise };

std::uint64_t seed_of(std::uint64_t seed, Purpose purpose, std::int64_t number) {
  return hash(hash(seed, static_cast<std::uint64_t>(purpose)), static_cast<std::uint64_t>(number));
}

}  // namespace

Pinhole scaled(const Pinhole& camera, int width) {
  const double scale = static_cast<double>(width) / camera.width;
  return {width,
          width * 3 / 4,
          scale * camera.fx,
          scale * camera.fy,
          scale * (camera.cx + 0.5) - 0.5,
          scale * (camera.cy + 0.5) - 0.5};
}

Eigen::Isometry3d Simulation::T_world_camera(std::int64_t k) const {
  const Eigen::Vector3d middle(0, 0, usual_target_m(config_.scene.kind));
  // Azimuth 0 stands at the long side of the table, where a robot would.
  const double azimuth =
      config_.azimuth_rad + config_.orbit_rad_per_frame * static_cast<double>(k) - std::numbers::pi / 2;
  const double level = std::cos(config_.elevation_rad);
  const Eigen::Vector3d direction(level * std::cos(azimuth), level * std::sin(azimuth),
                                  std::sin(config_.elevation_rad));
  return look_at(middle + config_.distance_m * direction, middle);
}

DepthFrame Simulation::frame(std::int64_t k) {
  const std::int64_t number = config_.new_scene_every > 0 ? k / config_.new_scene_every : 0;
  if (number != scene_number_) {
    scene_ = build_scene(config_.scene, seed_of(config_.seed, Purpose::kScene, number));
    scene_number_ = number;
    ideal_of_ = -1;
  }
  if (ideal_of_ < 0 || config_.orbit_rad_per_frame != 0) {
    ideal_ = render(scene_, config_.camera, T_world_camera(k));
    ideal_of_ = k;
  }
  return apply_sensor(ideal_, config_.sensor, seed_of(config_.seed, Purpose::kNoise, k));
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What real depth sensors add to and take from an ideal image.
#pragma once
#include <cstdint>
#include <optional>
#include <string_view>

#include "client/simulate/depth_camera.hpp"

namespace graspd {

/// Every effect is off at 0. Lengths in metres.
struct SensorModel {
  /// Deviation along the optical axis: constant + quadratic * (z - offset)^2.
  double noise_constant_m = 0;
  double noise_quadratic_per_m = 0;
  double noise_offset_m = 0;
  int noise_patch_px = 1;        ///< noise varies smoothly over patches of this size; 1: pixel by pixel
  double quantum_per_m = 0;      ///< a step of depth at 1 m; grows with z^2, as steps of disparity do
  double dropout = 0;            ///< share of pixels lost at random [0, 1]
  double grazing_cos = 0;        ///< surfaces seen at a smaller cosine are lost, gradually below twice of it
  double shadow_baseline_m = 0;  ///< projector or second camera, to the right: what it does not see is lost
  double flying = 0;             ///< share of pixels at depth edges that fall between both sides [0, 1]
  double edge_m = 0.02;          ///< a step in depth that counts as an edge
  double min_range_m = 0;
  double max_range_m = 0;  ///< 0: none
};

/// "ideal", "kinect" (structured light, first generation) or "realsense" (active stereo, D435).
[[nodiscard]] std::optional<SensorModel> sensor_model(std::string_view name);

/// The same image as such a sensor gives it. Lost pixels have depth 0, and they and flying ones belong to
/// nothing.
[[nodiscard]] DepthFrame apply_sensor(const DepthFrame& ideal, const SensorModel& model, std::uint64_t seed);

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/simulate/sensor_noise.hpp"

#include <algorithm>
#include <cmath>

#include "client/simulate/rng.hpp"

namespace graspd {
namespace {

/// Each effect draws from its own sequence, so that switching one leaves the others alone.
enum class Effect : std::uint64_t { kNoise = 1, kDropout, kGrazing, kFlying };
Rng rng_of(std::uint64_t seed, Effect effect) {
  return Rng(hash(seed, static_cast<std::uint64_t>(effect)));
}

void lose(DepthFrame& frame, std::size_t i) {
  frame.depth_m[i] = 0;
  frame.label[i] = kLabelInvalid;
}

/// Of one pixel's four neighbours, one at random that is across an edge; the pixel itself where there is
/// none.
std::size_t across_edge(const DepthFrame& frame, int u, int v, double edge_m, Rng& rng) {
  const int width = frame.camera.width;
  const auto i = static_cast<std::size_t>(v * width + u);
  constexpr int kSteps[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  const auto first = static_cast<int>(rng.bits() & 3);
  for (int k = 0; k < 4; ++k) {
    const auto& step = kSteps[(first + k) & 3];
    const int nu = u + step[0], nv = v + step[1];
    if (nu < 0 || nv < 0 || nu >= width || nv >= frame.camera.height) continue;
    const auto j = static_cast<std::size_t>(nv * width + nu);
    if (frame.depth_m[j] > 0 && std::abs(frame.depth_m[j] - frame.depth_m[i]) > edge_m) return j;
  }
  return i;
}

void add_flying_pixels(const DepthFrame& ideal, const SensorModel& model, std::uint64_t seed,
                       DepthFrame& frame) {
  if (model.flying <= 0) return;
  Rng rng = rng_of(seed, Effect::kFlying);
  std::size_t i = 0;
  for (int v = 0; v < ideal.camera.height; ++v) {
    for (int u = 0; u < ideal.camera.width; ++u, ++i) {
      if (ideal.depth_m[i] <= 0) continue;
      const std::size_t j = across_edge(ideal, u, v, model.edge_m, rng);
      if (j == i || rng.uniform() >= model.flying) continue;
      const auto share = static_cast<float>(rng.uniform(0.1, 0.9));
      frame.depth_m[i] = ideal.depth_m[i] + share * (ideal.depth_m[j] - ideal.depth_m[i]);
      frame.label[i] = kLabelInvalid;
    }
  }
}

/// Hides what the other eye of the sensor cannot see: seen from it, a nearer pixel covers the ones behind.
void cast_shadows(const DepthFrame& ideal, const SensorModel& model, DepthFrame& frame) {
  if (model.shadow_baseline_m <= 0) return;
  const double scale = ideal.camera.fx * model.shadow_baseline_m;
  for (int v = 0; v < ideal.camera.height; ++v) {
    double covered = 1e9;
    // From the right: a pixel's column in the other image is u - scale / z, and columns must keep falling.
    for (int u = ideal.camera.width - 1; u >= 0; --u) {
      const auto i = static_cast<std::size_t>(v * ideal.camera.width + u);
      if (ideal.depth_m[i] <= 0) continue;
      const double column = u - scale / static_cast<double>(ideal.depth_m[i]);
      if (column > covered) lose(frame, i);
      covered = std::min(covered, column);
    }
  }
}

void drop_out(const SensorModel& model, std::uint64_t seed, DepthFrame& frame) {
  if (model.dropout <= 0 && model.grazing_cos <= 0) return;
  Rng random = rng_of(seed, Effect::kDropout);
  Rng grazing = rng_of(seed, Effect::kGrazing);
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const bool lost = random.uniform() < model.dropout;
    // Certain below grazing_cos, impossible beyond twice of it.
    const double left = model.grazing_cos > 0 ? frame.cos_incidence[i] / model.grazing_cos - 1 : 1;
    if (lost || grazing.uniform() >= left) lose(frame, i);
  }
}

/// Deviates of a coarse grid, blended between its knots and scaled back to a deviation of 1 on average.
class NoiseField {
 public:
  NoiseField(int width, int height, int patch, Rng& rng) : patch_(patch), columns_(width / patch + 2) {
    knots_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(height / patch + 2));
    for (double& knot : knots_) knot = rng.normal();
  }

  [[nodiscard]] double at(int u, int v) const {
    const int cu = u / patch_, cv = v / patch_;
    const double fu = double(u % patch_) / patch_, fv = double(v % patch_) / patch_;
    const auto* knot = knots_.data() + cv * columns_ + cu;
    const double top = knot[0] + fu * (knot[1] - knot[0]);
    const double bottom = knot[columns_] + fu * (knot[columns_ + 1] - knot[columns_]);
    // Blending two independent deviates evenly over an edge leaves 2/3 of the variance, over a square 4/9.
    return (top + fv * (bottom - top)) * (patch_ > 1 ? 1.5 : 1.0);
  }

 private:
  int patch_;
  int columns_;
  std::vector<double> knots_;
};

double quantised(double z, double quantum_per_m) {
  // Equal steps of 1/z: at z the neighbouring values are quantum * z^2 apart.
  return 1 / (std::max(1.0, std::round(1 / (z * quantum_per_m))) * quantum_per_m);
}

void add_noise(const SensorModel& model, std::uint64_t seed, DepthFrame& frame) {
  Rng rng = rng_of(seed, Effect::kNoise);
  const NoiseField field(frame.camera.width, frame.camera.height, model.noise_patch_px, rng);
  std::size_t i = 0;
  for (int v = 0; v < frame.camera.height; ++v) {
    for (int u = 0; u < frame.camera.width; ++u, ++i) {
      double z = static_cast<double>(frame.depth_m[i]);
      if (z <= 0) continue;
      const double beyond = z - model.noise_offset_m;
      z += field.at(u, v) * (model.noise_constant_m + model.noise_quadratic_per_m * beyond * beyond);
      if (model.quantum_per_m > 0 && z > 0) z = quantised(z, model.quantum_per_m);
      if (z <= model.min_range_m || (model.max_range_m > 0 && z > model.max_range_m)) {
        lose(frame, i);
      } else {
        frame.depth_m[i] = static_cast<float>(z);
      }
    }
  }
}

}  // namespace

std::optional<SensorModel> sensor_model(std::string_view name) {
  SensorModel model;
  if (name == "ideal") return model;
  model.flying = 0.35;
  if (name == "kinect") {
    // Noise: Nguyen, Izadi and Lovell 2012. Steps: Khoshelham and Elberink 2012.
    model.noise_constant_m = 0.0012;
    model.noise_quadratic_per_m = 0.0019;
    model.noise_offset_m = 0.4;
    model.quantum_per_m = 0.00285;
    model.dropout = 0.003;
    model.grazing_cos = 0.10;
    model.shadow_baseline_m = 0.075;
    model.flying = 0.15;
    model.min_range_m = 0.40;
    model.max_range_m = 4.0;
    return model;
  }
  if (name == "realsense") {
    // 0.08 pixels of disparity at a baseline of 50 mm, smooth over a matching window.
    model.noise_constant_m = 0.0002;
    model.noise_quadratic_per_m = 0.0030;
    model.noise_patch_px = 4;
    model.quantum_per_m = 0.0012;
    model.dropout = 0.008;
    model.grazing_cos = 0.06;
    model.shadow_baseline_m = 0.050;
    model.min_range_m = 0.28;
    model.max_range_m = 4.0;
    return model;
  }
  return std::nullopt;
}

DepthFrame apply_sensor(const DepthFrame& ideal, const SensorModel& model, std::uint64_t seed) {
  DepthFrame frame = ideal;
  add_flying_pixels(ideal, model, seed, frame);
  cast_shadows(ideal, model, frame);
  drop_out(model, seed, frame);
  add_noise(model, seed, frame);
  return frame;
}

}  // namespace graspd

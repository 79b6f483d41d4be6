// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/bench/bench_clouds.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "client/common/cloud_file.hpp"
#include "client/common/cloud_list.hpp"
#include "client/common/text.hpp"
#include "client/simulate/simulation.hpp"
#include "service/pipeline/downsample.hpp"
#include "service/pipeline/workspace_filter.hpp"

namespace graspd {
namespace {

constexpr double kPixelsPerVoxel = 5;
constexpr double kNoisePerLeaf = 0.15;
constexpr double kMaxRange_m = 0.95;  // the table and a little of the floor, not all of the room

SimulationConfig simulation(const BenchOptions& options, int width) {
  SimulationConfig config;
  config.scene.kind = scene_kind(options.scene).value();
  config.camera = scaled(config.camera, width);
  config.elevation_rad = usual_elevation_deg(config.scene.kind) * std::numbers::pi / 180;
  config.seed = options.seed;
  config.new_scene_every = 1;
  config.sensor.max_range_m = kMaxRange_m;
  return config;
}

PointCloud finite(const PointCloud& cloud) {
  return filter_workspace(cloud, {}).cloud;
}

BenchCloud as_voxels(BenchCloud bench, float leaf_m) {
  bench.cloud = downsample(finite(bench.cloud), {leaf_m}).cloud;
  return bench;
}

}  // namespace

BenchImage simulated_image(const BenchOptions& options, int number, int width) {
  SimulationConfig config = simulation(options, width);
  config.sensor = sensor_model("kinect").value();
  config.sensor.max_range_m = kMaxRange_m;
  Simulation camera(config);
  return {config.camera, to_cloud(camera.frame(number)).cloud};
}

std::vector<BenchCloud> stage_clouds(const BenchOptions& options) {
  std::vector<BenchCloud> clouds;
  if (options.inputs.empty()) {
    for (int i = 0; i < options.scenes; ++i)
      clouds.push_back({printed("%s %d", options.scene.c_str(), i),
                        simulated_image(options, i, options.width).cloud, options.leaf_m});
  } else {
    for (const auto& path : list_cloud_files(options.inputs))
      clouds.push_back({path.filename().string(), load_cloud(path).cloud, options.leaf_m});
  }
  if (!options.full)
    for (BenchCloud& bench : clouds) bench = as_voxels(std::move(bench), options.leaf_m);
  return clouds;
}

BenchCloud scaled_cloud(const BenchOptions& options, std::size_t num_points) {
  const auto wanted = static_cast<double>(num_points);
  const int width = std::max(64, static_cast<int>(std::sqrt(kPixelsPerVoxel * wanted * 4 / 3)));
  const SimulationConfig config = simulation(options, width);
  const DepthFrame ideal = Simulation(config).frame(0);
  SensorModel noise = config.sensor;
  noise.noise_constant_m =
      kNoisePerLeaf * static_cast<double>(leaf_for(finite(to_cloud(ideal).cloud), num_points));
  const PointCloud noisy = finite(to_cloud(apply_sensor(ideal, noise, options.seed)).cloud);
  const float leaf_m = leaf_for(noisy, num_points);
  return as_voxels({printed("%zu points", num_points), noisy, leaf_m}, leaf_m);
}

float leaf_for(const PointCloud& cloud, std::size_t num_points) {
  if (num_points == 0 || cloud.size() < num_points)
    throw std::invalid_argument(printed("%zu points cannot be made of %zu", num_points, cloud.size()));
  const auto count = [&](double leaf_m) {
    return static_cast<double>(downsample(cloud, {static_cast<float>(leaf_m)}).cloud.size());
  };
  const auto wanted = static_cast<double>(num_points);
  double low = 2e-4, high = 0.5;  // more voxels, fewer voxels
  double leaf_m = 0.02;
  for (int i = 0; i < 20; ++i) {
    const double ratio = count(leaf_m) / wanted;
    if (std::abs(ratio - 1) < 0.01) break;
    (ratio > 1 ? low : high) = leaf_m;
    // Surfaces have four times the voxels at half the edge; where that leads out of the bracket, its middle.
    const double guess = leaf_m * std::sqrt(ratio);
    leaf_m = guess > low && guess < high ? guess : std::sqrt(low * high);
  }
  return static_cast<float>(leaf_m);
}

}  // namespace graspd

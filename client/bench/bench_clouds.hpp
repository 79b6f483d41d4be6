// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What is measured on: clouds from files, or images of a simulated camera.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "client/bench/bench_options.hpp"
#include "client/common/pinhole.hpp"
#include "service/pipeline/point_cloud.hpp"

namespace graspd {

struct BenchCloud {
  std::string name;
  PointCloud cloud;
  float leaf_m = 0;  ///< that goes with it [m]
};

/// One image of a Kinect over a simulated scene: organized, missing points NaN. number: which scene.
struct BenchImage {
  Pinhole camera;
  PointCloud cloud;
};
[[nodiscard]] BenchImage simulated_image(const BenchOptions& options, int number, int width);

/// For the suite stages: the files or simulated images, as voxels of the options' size, or with --full as
/// they are. Throws CloudFileError.
[[nodiscard]] std::vector<BenchCloud> stage_clouds(const BenchOptions& options);

/// The first simulated scene as about num_points voxels, and their edge. Seen with so many pixels that each
/// voxel holds some of them, and with noise that is the same share of the edge for any number of points.
[[nodiscard]] BenchCloud scaled_cloud(const BenchOptions& options, std::size_t num_points);

/// The edge of the voxels [m] that leaves a cloud of finite points with about num_points of them, within 1 %
/// where there is such an edge. Throws std::invalid_argument where the cloud has fewer points.
[[nodiscard]] float leaf_for(const PointCloud& cloud, std::size_t num_points);

}  // namespace graspd

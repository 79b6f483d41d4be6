// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/benchmark/bench_clouds.hpp"

#include "client/common/cloud_file.hpp"
#include "client/common/cloud_list.hpp"
#include "service/pipeline/downsample.hpp"
#include "service/pipeline/workspace_filter.hpp"
#include "tests/support/clouds.hpp"
#include "tests/support/scene_gallery.hpp"

namespace graspd {
namespace {

PointCloud cropped_scene() {
  WorkspaceFilterConfig table;
  table.min_m = {-0.5f, -0.45f, -0.1f};
  table.max_m = {0.5f, 0.45f, 1.0f};
  const PointCloud scene =
      filter_workspace(with_range_noise(render(spread_objects()).cloud, 0.0007f, 1), table).cloud;
  // Half a default voxel up: a table on the border of two layers of voxels would count twice.
  return moved(scene, Eigen::Isometry3f(Eigen::Translation3f(0, 0, 0.00225f)));
}

}  // namespace

std::vector<BenchCloud> bench_clouds(const std::vector<std::string>& arguments, float leaf_m) {
  std::vector<BenchCloud> clouds;
  if (arguments.empty()) {
    clouds.push_back({"scene", cropped_scene()});
  } else {
    for (const auto& path : list_cloud_files(arguments))
      clouds.push_back({path.filename().string(), load_cloud(path).cloud});
  }
  if (leaf_m > 0)
    for (BenchCloud& bench : clouds)
      bench.cloud = downsample(filter_workspace(bench.cloud, {}).cloud, {leaf_m}).cloud;
  return clouds;
}

}  // namespace graspd

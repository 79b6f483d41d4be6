// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/pipeline/voxel_surfaces.hpp"

#include <map>

#include "service/pipeline/downsample.hpp"

namespace graspd {

VoxelSurfaces voxel_surfaces(const RenderedScene& scene, const SmoothnessConfig& config) {
  PointCloud points;
  points.viewpoint = scene.cloud.viewpoint;
  std::vector<int> solid;
  for (std::size_t i = 0; i < scene.cloud.size(); ++i) {
    if (scene.solid_of_point[i] < 0) continue;
    points.push_back(scene.cloud.point(i));
    solid.push_back(scene.solid_of_point[i]);
  }
  Downsampled voxels = downsample(points, {kTestLeaf});
  std::vector<std::map<int, int>> votes(voxels.cloud.size());
  for (std::size_t i = 0; i < points.size(); ++i) ++votes[voxels.voxel_of_point[i]][solid[i]];
  VoxelSurfaces s;
  for (const std::map<int, int>& vote : votes) {
    auto most = vote.begin();
    for (auto it = vote.begin(); it != vote.end(); ++it)
      if (it->second > most->second) most = it;
    s.solid.push_back(most->first);
  }
  s.cloud = std::move(voxels.cloud);
  s.neighborhoods = find_neighborhoods(s.cloud, {kTestRadius});
  s.normals = estimate_normals(s.cloud, s.neighborhoods);
  s.is_edge = find_edge_points(s.normals, s.neighborhoods, config);
  return s;
}

std::pmr::vector<std::uint8_t> support_points(const std::optional<Support>& support) {
  return support ? support->is_support : std::pmr::vector<std::uint8_t>{};
}

}  // namespace graspd

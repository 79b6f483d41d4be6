// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/surfaces.hpp"

#include <utility>

namespace graspd {
Surfaces find_surfaces(const PointCloud& cloud, const DetectConfig& config, const StageObserver& done) {
  const float leaf = config.downsample.leaf_size_m;
  Surfaces s;
  Downsampled voxels = downsample(cloud, config.downsample);
  s.cloud = std::move(voxels.cloud);
  s.voxel_of_point = std::move(voxels.voxel_of_point);
  done("downsample");
  Neighborhoods neighborhoods = find_neighborhoods(s.cloud, config.neighborhoods);
  done("neighborhoods");
  s.normals = estimate_normals(s.cloud, neighborhoods);
  done("normals");
  for (int i = 0; i < config.smoothing.iterations; ++i) {
    s.cloud = smooth(s.cloud, s.normals, neighborhoods);
    neighborhoods = find_neighborhoods(s.cloud, config.neighborhoods);
    s.normals = estimate_normals(s.cloud, neighborhoods);
  }
  done("smoothing");
  s.is_edge = find_edge_points(s.normals, neighborhoods, config.smoothness);
  done("edge_points");
  s.support = find_support(s.cloud, s.normals, leaf, config.support);
  done("support");
  const std::vector<std::uint8_t> no_support;
  const std::vector<std::uint8_t>& is_support = s.support ? s.support->is_support : no_support;
  Labels labels = grow_regions(s.normals, neighborhoods, s.is_edge, is_support, config.smoothness);
  done("region_growing");
  s.segments = build_segments(s.cloud, labels, leaf, config.segments);
  done("segments");
  s.objects = group_segments(s.cloud, s.normals, neighborhoods, s.segments, is_support, config.objects);
  done("objects");
  return s;
}

}  // namespace graspd

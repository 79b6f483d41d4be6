// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/surfaces.hpp"

#include <tbb/parallel_invoke.h>

#include <utility>

#include "service/pipeline/leftovers.hpp"
#include "service/pipeline/thin_out.hpp"

namespace graspd {
namespace {

constexpr float kQueryCell = 0.03f;     // of the grid for box queries [m]
constexpr float kSparseLeaves = 1.33f;  // between the voxels of first looks: with more, objects are missed

/// The support's points, which have no neighbourhoods, have the plane's normal.
Normals surface_normals(const PointCloud& cloud, const Neighborhoods& neighborhoods,
                        const std::optional<Support>& support) {
  return support ? estimate_normals(cloud, neighborhoods, support->plane.normal)
                 : estimate_normals(cloud, neighborhoods);
}

void mark_support(const Support& support, std::pmr::vector<std::int32_t>& object_of_point) {
  const std::uint8_t* is_support = support.is_support.data();
  std::int32_t* object = object_of_point.data();
  for (std::size_t i = 0; i < object_of_point.size(); ++i)
    object[i] = is_support[i] != 0 ? kSupportObject : object[i];
}

/// Marks the walls of a container as fixed and takes them out of the labels; false where there is none.
bool take_out_container(const Surfaces& s, const DetectConfig& config,
                        std::pmr::vector<std::uint8_t>& is_fixed, Labels& labels) {
  if (!s.support) return false;
  const std::pmr::vector<std::uint8_t> is_wall =
      find_container(s.cloud, s.segments, *s.support, config.container);
  for (std::size_t i = 0; i < is_wall.size(); ++i) {
    if (!is_wall[i]) continue;
    is_fixed[i] = 1;
    labels.of_point[i] = -1;
  }
  return !is_wall.empty();
}

SparseVoxels spread_thinly(const PointCloud& voxels, float spacing_m) {
  const std::pmr::vector<std::uint32_t> chosen = thin_out(voxels, spacing_m);
  const PointCloud cloud = points_at(voxels, chosen);
  // In the query's own order, so that what is known of neighbours is near in memory.
  const CellOrder order = order_by_cell(cloud, kQueryCell);
  SparseVoxels sparse;
  sparse.spacing_m = spacing_m;
  sparse.voxel.reserve(chosen.size());
  for (const std::uint32_t i : order.points) sparse.voxel.push_back(chosen[i]);
  sparse.cloud = points_at(cloud, order.points);
  sparse.query = BoxQuery(sparse.cloud, kQueryCell);
  return sparse;
}

/// From normals to segments and objects.
void find_objects(const Neighborhoods& neighborhoods, const DetectConfig& config, const StageObserver& done,
                  Surfaces& s) {
  const float leaf = config.downsample.leaf_size_m;
  const std::pmr::vector<std::uint8_t> none;
  const std::pmr::vector<std::uint8_t>& is_support = s.support ? s.support->is_support : none;
  s.is_edge = find_edge_points(s.normals, neighborhoods, config.smoothness);
  done("edge_points");
  Labels labels = grow_regions(s.normals, neighborhoods, s.is_edge, is_support, config.smoothness);
  label_leftovers(s.cloud, neighborhoods, is_support, config.segments.min_area_m2 / (leaf * leaf), labels);
  done("region_growing");
  s.segments = build_segments(s.cloud, labels, leaf, config.segments);
  std::pmr::vector<std::uint8_t> is_fixed = is_support;
  if (take_out_container(s, config, is_fixed, labels))
    s.segments = build_segments(s.cloud, labels, leaf, config.segments);
  done("segments");
  s.objects = group_segments(s.cloud, s.normals, neighborhoods, s.segments, is_fixed, config.objects);
  if (s.support) mark_support(*s.support, s.objects.of_point);
  s.wholes = merge_objects(s.cloud, s.normals, neighborhoods, s.objects, config.objects);
  done("objects");
}

}  // namespace

Surfaces find_surfaces(const PointCloud& cloud, const DetectConfig& config, const StageObserver& done,
                       const ImagePixels& pixels) {
  Surfaces s;
  Downsampled voxels = downsample(cloud, config.downsample, pixels);
  s.cloud = std::move(voxels.cloud);
  s.voxel_of_point = std::move(voxels.voxel_of_point);
  done("downsample");
  s.support = find_support(s.cloud, config.support);
  const std::pmr::vector<std::uint8_t> none;
  const std::pmr::vector<std::uint8_t>& is_support = s.support ? s.support->is_support : none;
  done("support");
  Neighborhoods neighborhoods = find_neighborhoods(s.cloud, config.neighborhoods, is_support);
  done("neighborhoods");
  s.normals = surface_normals(s.cloud, neighborhoods, s.support);
  done("normals");
  for (int i = 0; i < config.smoothing.iterations; ++i) {
    s.cloud = smooth(s.cloud, s.normals, neighborhoods);
    neighborhoods = find_neighborhoods(s.cloud, config.neighborhoods, is_support);
    s.normals = surface_normals(s.cloud, neighborhoods, s.support);
  }
  done("smoothing");
  tbb::parallel_invoke(
      [&] { s.sparse = spread_thinly(s.cloud, kSparseLeaves * config.downsample.leaf_size_m); },
      [&] { find_objects(neighborhoods, config, done, s); });
  return s;
}

}  // namespace graspd

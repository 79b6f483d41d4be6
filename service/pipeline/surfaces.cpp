// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/surfaces.hpp"

#include <tbb/parallel_for.h>

#include <utility>

#include "service/pipeline/leftovers.hpp"
#include "service/pipeline/members.hpp"
#include "service/pipeline/run_beside.hpp"
#include "service/pipeline/thin_out.hpp"

namespace graspd {
namespace {

constexpr float kPointCell = 0.02f;     // of the grid for box queries [m]
constexpr float kSparseCell = 0.03f;    // of that of sparse voxels [m]
constexpr float kSparseLeaves = 1.33f;  // between the voxels of first looks: with more, objects are missed

/// The support's points, which have no neighbourhoods, have the plane's normal.
Normals surface_normals(const PointCloud& cloud, const Neighborhoods& neighborhoods,
                        const std::optional<Support>& support) {
  return support ? estimate_normals(cloud, neighborhoods, support->plane.normal)
                 : estimate_normals(cloud, neighborhoods);
}

/// Takes the walls of a container out of the labels and the segments. Returns 1 for each point of the support
/// and of the walls; nothing where there is no container.
std::pmr::vector<std::uint8_t> take_out_container(const DetectConfig& config, Labels& labels, Surfaces& s) {
  if (!s.support) return {};
  std::pmr::vector<std::uint8_t> is_fixed = find_container(s.cloud, s.segments, *s.support, config.container);
  if (is_fixed.empty()) return {};
  for (std::size_t i = 0; i < is_fixed.size(); ++i) {
    if (is_fixed[i]) labels.of_point[i] = -1;
    is_fixed[i] |= s.support->is_support[i];
  }
  s.segments = build_segments(s.cloud, labels, config.downsample.leaf_size_m, config.segments);
  return is_fixed;
}

/// The points that are not the support's: how far fingers may go to it is told by its plane, not by points
/// that scatter about it.
BoxQuery query_above(const PointCloud& cloud, const Surfaces& s) {
  if (!s.support) return {cloud, kPointCell};
  std::pmr::vector<std::uint8_t> is_support(cloud.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cloud.size(), 16384), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i)
      is_support[i] = s.support->is_support[s.voxel_of_point[i]];
  });
  return {cloud, order_by_cell(cloud, unmarked(is_support, cloud.size()), kPointCell)};
}

SparseVoxels spread_thinly(const PointCloud& voxels, const std::pmr::vector<std::uint8_t>& is_support,
                           float spacing_m) {
  const std::pmr::vector<std::uint32_t> chosen =
      thin_out(voxels, unmarked(is_support, voxels.size()), spacing_m);
  CellOrder order = order_by_cell(voxels, chosen, kSparseCell);
  SparseVoxels sparse;
  sparse.spacing_m = spacing_m;
  // In the query's own order, so that what is known of neighbours is near in memory.
  sparse.voxel = order.points;
  sparse.cloud = points_at(voxels, sparse.voxel);
  sparse.query = BoxQuery(sparse.cloud, in_order(std::move(order)));
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
  const float min_points = config.segments.min_area_m2 / (leaf * leaf);
  label_leftovers(s.cloud, neighborhoods, is_support, min_points, labels);
  done("region_growing");
  s.segments = build_segments(s.cloud, labels, leaf, config.segments);
  const std::pmr::vector<std::uint8_t> is_fixed = take_out_container(config, labels, s);
  done("segments");
  s.objects = group_segments(s.cloud, s.normals, neighborhoods, s.segments,
                             is_fixed.empty() ? is_support : is_fixed, config.objects);
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
  const int iterations = smoothing_iterations(config.smoothing, s.support ? s.support->sigma_m : 0);
  for (int i = 0; i < iterations; ++i) {
    s.cloud = smooth(s.cloud, s.normals, neighborhoods);
    neighborhoods = find_neighborhoods(s.cloud, config.neighborhoods, is_support);
    s.normals = surface_normals(s.cloud, neighborhoods, s.support);
  }
  done("smoothing");
  run_beside(
      [&] { s.sparse = spread_thinly(s.cloud, is_support, kSparseLeaves * config.downsample.leaf_size_m); },
      [&] { s.points = query_above(cloud, s); }, [&] { find_objects(neighborhoods, config, done, s); });
  return s;
}

}  // namespace graspd

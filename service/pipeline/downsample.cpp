// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/downsample.hpp"

#include <tbb/parallel_for.h>

#include "service/pipeline/cell_order.hpp"
#include "service/pipeline/image_blocks.hpp"

namespace graspd {

namespace {

/// Means of the points of cells [begin, end).
void set_means(const PointCloud& cloud, const CellRuns& cells, std::size_t begin, std::size_t end,
               Downsampled& out) {
  const float *xs = cloud.x.data(), *ys = cloud.y.data(), *zs = cloud.z.data();
  std::uint32_t* voxel = out.voxel_of_point.data();
  for (std::size_t c = begin; c < end; ++c) {
    const std::span<const PointSpan> runs = cells.cell(c);
    // Sums relative to the voxel's first point: no loss of digits far from the origin.
    const std::uint32_t first = runs.front().begin;
    const float x = xs[first], y = ys[first], z = zs[first];
    float sum_x = 0, sum_y = 0, sum_z = 0;
    std::uint32_t num = 0;
    for (const PointSpan& run : runs) {
      num += run.end - run.begin;
      std::uint32_t i = run.begin;
      do {
        sum_x += xs[i] - x;
        sum_y += ys[i] - y;
        sum_z += zs[i] - z;
        voxel[i] = static_cast<std::uint32_t>(c);
      } while (++i != run.end);
    }
    const auto n = static_cast<float>(num);
    out.cloud.x[c] = x + sum_x / n;
    out.cloud.y[c] = y + sum_y / n;
    out.cloud.z[c] = z + sum_z / n;
  }
}

Downsampled thin_by_voxels(const PointCloud& cloud, float leaf_size_m) {
  const CellRuns cells = runs_by_cell(cloud, leaf_size_m);
  Downsampled result;
  PointCloud& voxels = result.cloud;
  voxels.viewpoint = cloud.viewpoint;
  voxels.resize(cells.num_cells());
  voxels.width = static_cast<int>(cells.num_cells());
  result.voxel_of_point.resize(cloud.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells.num_cells(), 2048),
                    [&](const auto& range) { set_means(cloud, cells, range.begin(), range.end(), result); });
  return result;
}

}  // namespace

Downsampled downsample(const PointCloud& cloud, const DownsampleConfig& config, const ImagePixels& pixels) {
  if (config.image_blocks)
    if (const auto camera = fit_pinhole(cloud, pixels))
      return thin_by_blocks(cloud, pixels, *camera, config.leaf_size_m);
  return thin_by_voxels(cloud, config.leaf_size_m);
}

}  // namespace graspd

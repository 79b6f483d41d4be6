// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/downsample.hpp"

#include <tbb/parallel_for.h>

#include "service/pipeline/cell_order.hpp"
#include "service/pipeline/image_blocks.hpp"

namespace graspd {

namespace {

/// Means of the points of cells [begin, end), and whose points they are.
void set_means(const PointCloud& cloud, const CellOrder& cells, std::size_t begin, std::size_t end,
               Downsampled& out) {
  point_kernels().set_means(cells.of(cloud, begin, end), out.cloud.x.data() + begin,
                            out.cloud.y.data() + begin, out.cloud.z.data() + begin);
  const std::uint32_t* point = cells.points.data() + cells.starts[begin];
  std::uint32_t* voxel = out.voxel_of_point.data();
  for (std::size_t c = begin; c < end; ++c)
    for (std::uint32_t left = cells.starts[c + 1] - cells.starts[c]; left > 0; --left)
      voxel[*point++] = static_cast<std::uint32_t>(c);
}

Downsampled thin_by_voxels(const PointCloud& cloud, float leaf_size_m) {
  const CellOrder cells = order_by_cell(cloud, leaf_size_m);
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

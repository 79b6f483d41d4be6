// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/downsample.hpp"

#include <tbb/parallel_for.h>

#include "service/pipeline/cell_order.hpp"
#include "service/pipeline/image_blocks.hpp"

namespace graspd {

namespace {

/// Sets whose points the points of cells [begin, end) are.
void set_cells(const CellOrder& cells, std::size_t begin, std::size_t end, std::uint32_t* cell_of_point) {
  const std::uint32_t* point = cells.points.data() + cells.starts[begin];
  for (std::size_t c = begin; c < end; ++c)
    for (std::uint32_t left = cells.starts[c + 1] - cells.starts[c]; left > 0; --left)
      cell_of_point[*point++] = static_cast<std::uint32_t>(c);
}

Downsampled thin_by_voxels(const PointCloud& cloud, float leaf_size_m) {
  const CellOrder cells = order_by_cell(cloud, leaf_size_m);
  Downsampled result{cell_means(cloud, cells), {}};
  result.voxel_of_point.resize(cloud.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells.num_cells(), 2048), [&](const auto& range) {
    set_cells(cells, range.begin(), range.end(), result.voxel_of_point.data());
  });
  return result;
}

}  // namespace

PointCloud cell_means(const PointCloud& cloud, const CellOrder& cells) {
  PointCloud means = unorganized_cloud(cells.num_cells(), cloud.viewpoint);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells.num_cells(), 2048), [&](const auto& range) {
    const std::size_t c = range.begin();
    point_kernels().set_means(cells.of(cloud, c, range.end()), means.x.data() + c, means.y.data() + c,
                              means.z.data() + c);
  });
  return means;
}

Downsampled downsample(const PointCloud& cloud, const DownsampleConfig& config, const ImagePixels& pixels) {
  if (config.image_blocks)
    if (const auto camera = fit_pinhole(cloud, pixels))
      return thin_by_blocks(cloud, pixels, *camera, config.leaf_size_m);
  return thin_by_voxels(cloud, config.leaf_size_m);
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/downsample.hpp"

#include <tbb/parallel_for.h>

#include "service/pipeline/cell_order.hpp"
#include "service/pipeline/image_blocks.hpp"

namespace graspd {

namespace {

Downsampled thin_by_voxels(const PointCloud& cloud, float leaf_size_m) {
  const CellOrder order = order_by_cell(cloud, leaf_size_m);
  Downsampled result;
  PointCloud& voxels = result.cloud;
  voxels.viewpoint = cloud.viewpoint;
  voxels.resize(order.num_cells());
  voxels.width = static_cast<int>(order.num_cells());
  result.voxel_of_point.resize(cloud.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, order.num_cells(), 2048), [&](const auto& range) {
    for (std::size_t c = range.begin(); c != range.end(); ++c) {
      // Sums relative to the voxel's first point: no loss of digits far from the origin.
      const Eigen::Vector3f first = cloud.point(order.cell(c).front());
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      for (const std::uint32_t i : order.cell(c)) {
        sum += cloud.point(i) - first;
        result.voxel_of_point[i] = static_cast<std::uint32_t>(c);
      }
      const Eigen::Vector3f mean = first + sum / static_cast<float>(order.cell(c).size());
      voxels.x[c] = mean.x();
      voxels.y[c] = mean.y();
      voxels.z[c] = mean.z();
    }
  });
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

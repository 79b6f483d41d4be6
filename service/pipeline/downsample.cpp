// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/downsample.hpp"

#include <tbb/parallel_for.h>

#include "service/pipeline/cell_order.hpp"

namespace graspd {

Downsampled downsample(const PointCloud& cloud, const DownsampleConfig& config) {
  const CellOrder order = order_by_cell(cloud, config.leaf_size_m);
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

}  // namespace graspd

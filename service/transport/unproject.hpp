// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Pixels of a depth image -> points in the optical frame: x right, y down, z forward.
#pragma once
#include <cstddef>
#include <memory_resource>
#include <span>
#include <vector>

#include "service/pipeline/point_cloud.hpp"
#include "service/transport/cloud_input.hpp"

namespace graspd {

/// The pinhole model, for a cloud that has the image's size. depth_of(row, u) gives the distance along z of
/// pixel u of the row that starts there [m], NaN for none; rows start row_stride bytes apart. A pixel's ray
/// does not depend on its depth, so each column's and row's share is computed once.
template <class DepthOf>
void unproject(std::span<const std::byte> data, std::size_t row_stride, const CameraIntrinsics& camera,
               const DepthOf& depth_of, PointCloud& cloud) {
  const auto width = static_cast<std::size_t>(cloud.width);
  const auto height = static_cast<std::size_t>(cloud.height);
  std::pmr::vector<float> column(width);
  for (std::size_t u = 0; u < width; ++u)
    column[u] = static_cast<float>((static_cast<double>(u) - camera.cx_px) / camera.fx_px);
  for (std::size_t v = 0; v < height; ++v) {
    const auto row = static_cast<float>((static_cast<double>(v) - camera.cy_px) / camera.fy_px);
    const std::byte* __restrict depths = data.data() + v * row_stride;
    const float* __restrict columns = column.data();
    float* __restrict x = cloud.x.data() + v * width;
    float* __restrict y = cloud.y.data() + v * width;
    float* __restrict z = cloud.z.data() + v * width;
    for (std::size_t u = 0; u < width; ++u) {
      const float distance = depth_of(depths, u);
      x[u] = columns[u] * distance;
      y[u] = row * distance;
      z[u] = distance;
    }
  }
}

}  // namespace graspd

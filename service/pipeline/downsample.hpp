// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// One point for each occupied voxel, or for each block of an image's pixels: the mean of the points in it.
#pragma once
#include <cstdint>

#include "service/pipeline/cell_order.hpp"
#include "service/pipeline/config_fields.hpp"
#include "service/pipeline/pinhole_fit.hpp"
#include "service/pipeline/point_cloud.hpp"
#include "service/pipeline/raw_vector.hpp"

namespace graspd {

struct DownsampleConfig {
  float leaf_size_m = 0.003f;
  bool image_blocks = false;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& v) {
    v("leaf_size_m", self.leaf_size_m, Range{0.0005, 0.1}, "edge of a voxel [m]; one point is kept for each");
    v("image_blocks", self.image_blocks, Range{},
      "organized clouds in the optical frame: blocks of pixels as wide as a voxel instead of voxels");
  }
};

struct Downsampled {
  PointCloud cloud;  ///< one point a voxel, unorganized; by rows of voxels or of the image
  RawVector<std::uint32_t> voxel_of_point;  ///< for each input point the index of its voxel's point
};

/// All points must be finite. pixels: of the cloud's points, where it is part of an image.
[[nodiscard]] Downsampled downsample(const PointCloud& cloud, const DownsampleConfig& config,
                                     const ImagePixels& pixels = {});

/// The mean of the points of each cell, in the cells' order.
[[nodiscard]] PointCloud cell_means(const PointCloud& cloud, const CellOrder& cells);

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Thins an organized cloud by blocks of its image: without a search, and with the points in its order.
#pragma once
#include "service/pipeline/downsample.hpp"
#include "service/pipeline/pinhole_fit.hpp"

namespace graspd {

/// One point for each square of pixels about as wide as a voxel at its depth, and for each surface that is
/// seen in it: the mean of points less than a voxel apart in depth. Surfaces along the line of sight have
/// fewer points than by voxels, those across it about as many. All points must be finite and before the
/// camera, and those of the pixels.
[[nodiscard]] Downsampled thin_by_blocks(const PointCloud& cloud, const ImagePixels& pixels,
                                         const PinholeModel& camera, float leaf_size_m);

}  // namespace graspd

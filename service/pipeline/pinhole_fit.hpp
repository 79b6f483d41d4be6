// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The pinhole model of the image that an organized cloud is, found from its points.
#pragma once
#include <cstdint>
#include <optional>

#include "service/pipeline/point_cloud.hpp"
#include "service/pipeline/raw_vector.hpp"

namespace graspd {

/// Where the points of a cloud lay in the organized cloud that they were taken from.
struct ImagePixels {
  int width = 0, height = 0;          ///< of the image; 0: there was none
  RawVector<std::uint32_t> of_point;  ///< for each point its pixel, row by row; ascending
};

/// Column u = fx x / z + cx and row v = fy y / z + cy, for x, y, z from the viewpoint along the cloud's axes.
struct PinholeModel {
  float fx_px, fy_px, cx_px, cy_px;
};

/// Least squares over points picked by constant random numbers. None unless fx and fy are positive and each
/// of these points lies within half a pixel of its own: the cloud is not in the optical frame, the image is
/// distorted, the points have been moved, there is no image or too little of it. All points must be finite.
[[nodiscard]] std::optional<PinholeModel> fit_pinhole(const PointCloud& cloud, const ImagePixels& pixels);

}  // namespace graspd

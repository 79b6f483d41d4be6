// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The pinhole camera behind an organized cloud, for sending clouds from files as depth images.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "service/pipeline/point_cloud.hpp"

namespace graspd {

/// Of an optical frame: x right, y down, z forward; pixel (u, v) has its centre at (u, v).
struct Pinhole {
  int width = 640;
  int height = 480;
  double fx = 525, fy = 525, cx = 319.5, cy = 239.5;
};

/// Fits u to x / z and v to y / z. A string says why where the cloud is no image of a pinhole camera at the
/// origin.
[[nodiscard]] std::variant<Pinhole, std::string> estimate_pinhole(const PointCloud& cloud);

/// Along z in units of depth_scale_m, rounded; 0 where there is no point or the unit cannot express it.
[[nodiscard]] std::vector<std::uint16_t> depth_units(std::span<const float> z_m, double depth_scale_m);

}  // namespace graspd

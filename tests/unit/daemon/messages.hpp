// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Small encoded messages for the daemon's tests.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "service/pipeline/point_cloud.hpp"

namespace graspd {

using Bytes = std::vector<std::byte>;

/// A box of 6 x 12 x 8 cm on a table, seen from above at 0.6 m, every 2.5 mm.
[[nodiscard]] PointCloud box_on_table();
/// All coordinates as given.
[[nodiscard]] PointCloud uniform_cloud(std::size_t points, float coordinate);
/// point_cloud_t in the frame "camera".
[[nodiscard]] Bytes cloud_message(std::int64_t seq, const PointCloud& cloud);
/// depth_image_t in the frame "camera": a wall at that distance, or nothing for 0.
[[nodiscard]] Bytes depth_message(std::int64_t seq, float distance_m);

}  // namespace graspd

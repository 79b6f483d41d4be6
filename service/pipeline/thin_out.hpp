// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Points of a cloud that stand for it, evenly spread.
#pragma once
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "service/pipeline/point_cloud.hpp"

namespace graspd {

/// Of the points with these indices: in each occupied cell of the spacing [m] the one nearest to the mean of
/// those in it, in the order of the cells. All points must be finite.
[[nodiscard]] std::pmr::vector<std::uint32_t> thin_out(const PointCloud& cloud,
                                                       std::span<const std::uint32_t> indices,
                                                       float spacing_m);

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Thin and strongly curved things, such as pens: no neighbourhood on them is smooth, so that no surface grows
// there.
#pragma once
#include "service/pipeline/neighborhoods.hpp"
#include "service/pipeline/region_growing.hpp"

namespace graspd {

/// Gives things of what is left between the surfaces labels of their own: points that take part and are of no
/// surface with min_points or more, connected by their neighbourhoods whatever their normals, at least that
/// many, and several times as long as wide or beside no surface. What is not long and beside one, such as the
/// neck of a bottle, is a part of something else. excluded: as for grow_regions.
void label_leftovers(const PointCloud& cloud, const Neighborhoods& neighborhoods,
                     const std::pmr::vector<std::uint8_t>& excluded, float min_points, Labels& labels);

}  // namespace graspd

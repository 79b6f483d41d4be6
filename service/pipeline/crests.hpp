// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Crests: where an object ends upwards in something narrow, such as the rim of a mug or the top edge of a
// book. Its surfaces say little about how to take it there, the crest's own direction does.
#pragma once
#include <cstdint>
#include <vector>

#include "service/pipeline/point_cloud.hpp"

namespace graspd {

struct Crest {
  std::uint32_t point = 0;                             ///< index into the cloud
  Eigen::Vector3f tangent = Eigen::Vector3f::UnitX();  ///< along the crest, unit length, across up
};

/// points: indices of one object's points; up: unit length; crests are at least spacing_m apart. In an order
/// fixed by the points' positions.
[[nodiscard]] std::vector<Crest> find_crests(const PointCloud& cloud,
                                             const std::vector<std::uint32_t>& points,
                                             const Eigen::Vector3f& up, float spacing_m);

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Connected smooth surfaces under two thresholds (paper, section 4.1), in a form that does not depend on the
// order of the points: s and p are linked when |s - p| <= r and (theta < theta_low, or theta < theta_high and
// neither is an edge point); surfaces are the connected components of the links. An edge point in a component
// that has no other kind takes the label of its most similar neighbour in a component that has.
#pragma once
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "service/pipeline/edge_points.hpp"

namespace graspd {

struct Labels {
  std::pmr::vector<std::int32_t>
      of_point;        ///< label of each point; -1: excluded, or an edge point that no surface is near
  int num_labels = 0;  ///< labels are 0 .. num_labels - 1, by the first point of each
};

/// excluded: 1 for each point that takes no part and keeps the label -1 (the support's, which would join the
/// objects on it); may be empty. Points without a neighbourhood take no part either.
[[nodiscard]] Labels grow_regions(const Normals& normals, const Neighborhoods& neighborhoods,
                                  const std::pmr::vector<std::uint8_t>& is_edge,
                                  const std::pmr::vector<std::uint8_t>& excluded,
                                  const SmoothnessConfig& config);

}  // namespace graspd

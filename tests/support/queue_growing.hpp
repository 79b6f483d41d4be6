// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The paper's region growing to the letter (section 4.1): a queue of seeds, and labels that depend on the
// order of the points. The oracle of the order-free form in service/pipeline.
#pragma once
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "service/pipeline/edge_points.hpp"

namespace graspd {

/// Label of each point. Seeds are taken in the order given (a permutation of all points).
[[nodiscard]] std::pmr::vector<std::int32_t> grow_by_queue(const Normals& normals,
                                                           const Neighborhoods& neighborhoods,
                                                           const std::pmr::vector<std::uint8_t>& is_edge,
                                                           const SmoothnessConfig& config,
                                                           const std::pmr::vector<std::uint32_t>& seeds);

/// Share of the points that two labellings agree on: those in pairs of labels that are each other's largest
/// overlap. Points with a negative label in either do not count.
[[nodiscard]] double agreement(const std::pmr::vector<std::int32_t>& a,
                               const std::pmr::vector<std::int32_t>& b);

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Candidates on the upper rims of bowls, cups and other thin walls: the hand comes along the wall, with a
// finger on either side of it.
#pragma once
#include <memory_resource>
#include <vector>

#include "service/pipeline/handle_search.hpp"

namespace graspd {

/// One candidate every spacing_m along the rims of an object: where its surface ends upwards (against the
/// support, without one towards the sensor) and nothing of the object goes on. The approach follows the wall
/// over the grasp depth, the closing axis is across it.
[[nodiscard]] std::pmr::vector<Candidate> rim_candidates(const SearchInput& in, std::size_t object,
                                                         const Gripper& gripper,
                                                         const HandleSearchConfig& config);

}  // namespace graspd

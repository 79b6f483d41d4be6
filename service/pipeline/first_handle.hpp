// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The handle of an object that is published first: of all that are about as good one that noise does not
// move.
#pragma once
#include <memory_resource>
#include <vector>

#include "service/pipeline/guess_search.hpp"

namespace graspd {

/// One for each object that has a handle, in the order of the objects, with its final score and marked as
/// first. Among those found and some that follow from the object's shape it is one that is good at more than
/// one place, is taken from above and has a narrow part of the object between the jaws, moved to the object's
/// middle. The best score alone would jump from frame to frame between places that are equally good.
[[nodiscard]] std::pmr::vector<FoundHandle> first_handles(const std::pmr::vector<FoundHandle>& found,
                                                          const Surfaces& surfaces, const Gripper& gripper,
                                                          const HandleCheckConfig& config,
                                                          CheckBuffersOfThreads& buffers);

}  // namespace graspd

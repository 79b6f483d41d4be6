// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Other level surfaces than the support that things stand on.
#pragma once
#include <memory_resource>
#include <vector>

#include "service/pipeline/coarse_surface.hpp"
#include "service/pipeline/level.hpp"
#include "service/pipeline/plane_search.hpp"
#include "service/pipeline/support.hpp"

namespace graspd {

/// The support, and surfaces above and below it, parallel to it, that are as large as configured, too wide to
/// be the tops of objects, and have things on them. The lowest first; empty where there is none but the
/// support.
[[nodiscard]] std::pmr::vector<Level> find_levels(CoarseSurface& coarse, const Plane& support,
                                                  const PlaneLimits& limits, const SupportConfig& config);

/// Whether something rises from the plane where its points are.
[[nodiscard]] bool has_things_on(CoarseSurface& coarse, const Plane& plane, const PlaneLimits& limits,
                                 const SupportConfig& config);

}  // namespace graspd

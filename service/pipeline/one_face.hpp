// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Whether what is between the jaws looks like one thing.
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "service/pipeline/scene_view.hpp"

namespace graspd {

/// How much smaller than a good part of what looks back along the approach its second largest face is, 1 at
/// best, 0 and less at worst: two large ones are those of two things side by side, such as books in a row.
/// Round objects have such faces above one another. 1 where no segments are known. between: positions in
/// local of the object's seen points between the jaws; approach: unit length.
[[nodiscard]] float one_face(const SceneView& scene, const LocalPoints& local,
                             const std::pmr::vector<std::uint32_t>& between, const Eigen::Vector3f& approach);

}  // namespace graspd

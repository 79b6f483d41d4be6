// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The first stages of the pipeline run on a rendered scene, for tests of the later ones.
#pragma once
#include <memory_resource>
#include <optional>
#include <vector>

#include "service/pipeline/edge_points.hpp"
#include "service/pipeline/support.hpp"
#include "tests/support/analytic_scene.hpp"

namespace graspd {

inline constexpr float kTestLeaf = 0.003f;
inline constexpr float kTestRadius = 0.009f;

struct VoxelSurfaces {
  PointCloud cloud;
  std::vector<int> solid;  ///< of each voxel: that of most of its points
  Neighborhoods neighborhoods;
  Normals normals;
  std::pmr::vector<std::uint8_t> is_edge;
};

[[nodiscard]] VoxelSurfaces voxel_surfaces(const RenderedScene& scene, const SmoothnessConfig& config = {});

/// is_support of a support, or no points.
[[nodiscard]] std::pmr::vector<std::uint8_t> support_points(const std::optional<Support>& support);

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What candidates are checked against: one resolution of the frame with everything the earlier stages found
// out about it.
#pragma once
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <vector>

#include "service/pipeline/box_query.hpp"
#include "service/pipeline/depth_map.hpp"
#include "service/pipeline/normals.hpp"
#include "service/pipeline/objects.hpp"
#include "service/pipeline/support.hpp"

namespace graspd {

/// The cloud at one resolution. References must outlive the view.
struct SceneView {
  const PointCloud& cloud;
  const BoxQuery& query;
  const std::pmr::vector<std::int32_t>& object_of_voxel;  ///< kSupportObject, or -1
  const Normals& normals;                                 ///< of the voxels
  const std::pmr::vector<std::uint32_t>& voxel;           ///< of each point
  const std::optional<Support>& support;
  const DepthMap& depth_map;
  const std::pmr::vector<std::uint32_t>& depth_map_voxel;  ///< of each point that the depth map was made of
  int tolerance = 0;    ///< stray points allowed in a volume that must be free
  int min_points = 0;   ///< of the object between the jaws
  float spacing_m = 0;  ///< of a sparse copy, which is even; 0 for the points as they were measured

  [[nodiscard]] bool is_sparse() const { return spacing_m > 0; }
  [[nodiscard]] Eigen::Vector3f normal(std::uint32_t point) const { return normals.at(voxel[point]); }
  [[nodiscard]] std::int32_t object_at(std::int32_t depth_map_point) const {
    return object_of_voxel[depth_map_voxel[static_cast<std::size_t>(depth_map_point)]];
  }
};

}  // namespace graspd

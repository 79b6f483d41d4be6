// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What candidates are checked against: one resolution of the frame with everything the earlier stages found
// out about it.
#pragma once
#include <cstdint>
#include <optional>
#include <span>

#include "service/pipeline/box_query.hpp"
#include "service/pipeline/depth_map.hpp"
#include "service/pipeline/far_sides.hpp"
#include "service/pipeline/normals.hpp"
#include "service/pipeline/objects.hpp"
#include "service/pipeline/support.hpp"

namespace graspd {

/// The cloud at one resolution. References and spans must outlive the view. Points of far sides are numbered
/// after the cloud's.
struct SceneView {
  const PointCloud& cloud;
  const BoxQuery& query;                          ///< the points that are not the support's
  std::span<const std::int32_t> object_of_voxel;  ///< negative: none
  const Normals& normals;                         ///< of the voxels
  /// Of each point; of those of far sides, one of the same object.
  std::span<const std::uint32_t> voxel;
  const std::optional<Support>& support;
  const DepthMap& depth_map;
  std::span<const std::uint32_t> depth_map_voxel;  ///< of each point that the depth map was made of
  int tolerance = 0;                               ///< stray points allowed in a volume that must be free
  int min_points = 0;                              ///< of the object between the jaws
  float spacing_m = 0;  ///< of a sparse copy, which is even; 0 for the points as they were measured
  const FarSides* far_sides = nullptr;  ///< null: none are known
  const Segments* segments = nullptr;   ///< of the voxels; null: none are known
  /// Index into the support's levels for each object; empty where it has none.
  std::span<const std::uint32_t> level_of_object = {};

  [[nodiscard]] bool is_sparse() const { return spacing_m > 0; }
  /// Whether a point was measured: else it is of a far side.
  [[nodiscard]] bool is_seen(std::uint32_t point) const { return point < cloud.size(); }
  [[nodiscard]] Eigen::Vector3f normal(std::uint32_t point) const {
    return is_seen(point) ? normals.at(voxel[point]) : far_sides->normals.at(point - cloud.size());
  }
  [[nodiscard]] std::int32_t object_at(std::int32_t depth_map_point) const {
    return object_of_voxel[depth_map_voxel[static_cast<std::size_t>(depth_map_point)]];
  }
  /// The plane that an object stands on; null where there is no support.
  [[nodiscard]] const Plane* plane_under(std::int32_t object) const {
    if (!support) return nullptr;
    return level_of_object.empty()
               ? &support->plane
               : &support->levels[level_of_object[static_cast<std::size_t>(object)]].plane;
  }
  /// The points of the cloud and of far sides in a box, as BoxQuery finds them.
  void find(const Eigen::Vector3f& origin, const Eigen::Matrix3f& rotation, const Eigen::Vector3f& min,
            const Eigen::Vector3f& max, LocalPoints& out) const {
    query.find(origin, rotation, min, max, out);
    if (far_sides != nullptr)
      far_sides->add_inside(box_test(origin, rotation, min, max), static_cast<std::uint32_t>(cloud.size()),
                            out);
  }
};

}  // namespace graspd

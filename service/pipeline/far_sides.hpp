// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What the sensor has not seen of round objects, as points: fingers must stay clear of it as of what is seen.
#pragma once
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "service/pipeline/box_query.hpp"
#include "service/pipeline/depth_map.hpp"
#include "service/pipeline/normals.hpp"

namespace graspd {

struct Surfaces;

struct BoundingBall {
  Eigen::Vector3f center = Eigen::Vector3f::Zero();  ///< [m]
  float radius = 0;                                  ///< [m]
};

struct FarSides {
  PointCloud cloud;  ///< points of the walls out of sight, about 4 mm apart
  Normals normals;   ///< of each of them, outward
  /// Voxels of the points of the workspace and of sparse voxels, and then of each of the far sides' points
  /// one of the same object.
  std::pmr::vector<std::uint32_t> voxel_of_point, voxel_of_sparse;
  std::pmr::vector<BoundingBall> bounds;  ///< around those of each object that has some
  BoxQuery query;

  /// Whether one of the points may be as near to a place.
  [[nodiscard]] bool may_be_near(const Eigen::Vector3f& p, float distance_m) const;
};

/// Every object that is part of a body of revolution goes on as it where that is hidden. Nothing for one of
/// whose body much would be where the sensor looks through.
[[nodiscard]] FarSides find_far_sides(const Surfaces& surfaces, const DepthMap& depth_map);

}  // namespace graspd

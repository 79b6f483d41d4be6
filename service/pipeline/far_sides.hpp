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
  RawVector<std::uint32_t> voxel_of_point, voxel_of_sparse;
  /// Points that follow one another and so are near each other.
  struct Part {
    BoundingBall bounds;
    PointSpan points;
  };
  std::pmr::vector<Part> parts;
  /// One object's, as parts that follow one another.
  struct Wall {
    BoundingBall bounds;
    std::uint32_t first_part, end_part;
  };
  std::pmr::vector<Wall> walls;
  PaddedPoints padded;  ///< the same points

  /// Adds those in a box, with indices from first_index on.
  void add_inside(const BoxTest& box, std::uint32_t first_index, LocalPoints& out) const;
  /// Whether more than limit are in a box.
  [[nodiscard]] bool has_more(const BoxTest& box, int limit) const;

 private:
  /// Calls visit(part) for those that may be in the box; it returns false to stop.
  template <class Visit>
  void for_each_near(const BoxTest& box, Visit visit) const;
};

/// Every object that is part of a body of revolution goes on as it where that is hidden. Nothing for one of
/// whose body much would be where the sensor looks through.
[[nodiscard]] FarSides find_far_sides(const Surfaces& surfaces, const DepthMap& depth_map);

}  // namespace graspd

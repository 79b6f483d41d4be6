// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The body of revolution that an object is part of, where what is seen of it tells one: a can, a bottle or a
// ball goes on behind as it does in front.
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "service/pipeline/normals.hpp"
#include "service/pipeline/point_cloud.hpp"

namespace graspd {

/// Its wall at one place of the axis.
struct RoundSlice {
  float along_m = 0;   ///< from the body's center, along its axis
  float radius_m = 0;  ///< mean of what is seen there
  float lean = 0;      ///< cosine between the wall's outward normal and the axis
};

struct RoundBody {
  Eigen::Vector3f center = Eigen::Vector3f::Zero();  ///< on the axis [m]
  Eigen::Vector3f axis = Eigen::Vector3f::UnitZ();   ///< unit length
  std::pmr::vector<RoundSlice> slices;               ///< ascending; places where no wall is seen have none
};

/// Distance between slices [m].
inline constexpr float kRoundSlice = 0.004f;

/// points: the object's, with normals. up: an axis to try beside those that the normals suggest. Lines along
/// the normals of a body of revolution meet its axis, and within a slice all points are as far from it;
/// nothing where this does not hold for most of the points on walls, or where they see too little of it to
/// tell.
[[nodiscard]] std::optional<RoundBody> fit_round_body(const PointCloud& cloud, const Normals& normals,
                                                      std::span<const std::uint32_t> points,
                                                      const std::optional<Eigen::Vector3f>& up);

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Which way the wall below a rim goes, told by more of it than gets between the jaws: these must meet thin
// walls within a few degrees, and what noise leaves of a strip as wide as a finger does not tell that.
#pragma once
#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

#include "service/pipeline/handle_search.hpp"

namespace graspd {

/// A place on a rim, where a surface ends upwards; directions have unit length.
struct Rim {
  Eigen::Vector3f p;   ///< [m]
  Eigen::Vector3f n;   ///< the surface's normal
  Eigen::Vector3f up;  ///< in the surface, away from the rest of it
};

/// An upright axis.
struct VesselAxis {
  Eigen::Vector3f center;  ///< on it [m]
  Eigen::Vector3f up;      ///< unit length
};

/// The axis of an object whose walls are round about an upright one, as those of cups and bowls are: most
/// lines along their normals, inside and outside, meet it. points: the object's.
[[nodiscard]] std::optional<VesselAxis> vessel_axis(const SearchInput& in,
                                                    std::span<const std::uint32_t> points,
                                                    const Eigen::Vector3f& up);

/// A curved surface through the wall around a place on its rim.
class RimWall {
 public:
  static constexpr float kReach = 0.055f;  ///< of the points that it is fitted to, around the place [m]

  /// near: the object's points within kReach. With an axis whose walls the place is on they follow their
  /// profile all around it, without one a quadratic surface. Nothing where there are too few of them.
  [[nodiscard]] static std::optional<RimWall> fit(const SearchInput& in, std::span<const std::uint32_t> near,
                                                  const Rim& rim, const std::optional<VesselAxis>& axis);

  /// Columns: along the rim, across the wall so far below the place [m] (its normal on the side of the
  /// rim's), and down along it there.
  [[nodiscard]] Eigen::Matrix3f gripper_axes(float below_m) const;

  /// How far the wall's profile is from straight over so much of it below the place [m].
  [[nodiscard]] float bend_m(float depth_m) const {
    return 0.125f * std::abs(changes_.y()) * depth_m * depth_m;
  }

  /// Standard error of the normal's direction [rad], as if every point had noise of its own: noise that
  /// neighbours share makes the true one several times as large.
  [[nodiscard]] float error_rad() const { return error_rad_; }

 private:
  [[nodiscard]] static std::optional<RimWall> fit_round(const SearchInput& in,
                                                        std::span<const std::uint32_t> near, const Rim& rim,
                                                        const VesselAxis& axis);
  [[nodiscard]] static std::optional<RimWall> fit_free(const SearchInput& in,
                                                       std::span<const std::uint32_t> near, const Rim& rim);

  Eigen::Vector3f out_, along_, up_;  // across the wall at the place, along the rim, upwards
  // How much farther out the wall is, a metre along the rim and a metre down, at the place; and how much
  // these change a metre farther down.
  Eigen::Vector2f slopes_ = Eigen::Vector2f::Zero(), changes_ = Eigen::Vector2f::Zero();
  float error_rad_ = 0;
};

}  // namespace graspd

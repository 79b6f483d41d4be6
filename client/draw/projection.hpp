// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// From metres to pixels: a pinhole camera or a view along parallel lines.
#pragma once
#include <Eigen/Geometry>
#include <optional>
#include <span>

namespace graspd {

/// Where a point is in the picture. nearness is greater for what is nearer, and changes evenly across the
/// picture of a plane: 1 / depth for a camera, -depth along parallel lines.
struct Projected {
  float u = 0, v = 0;  ///< right and down from the top left corner [pixels]
  float nearness = 0;
};

class Projection {
 public:
  enum class Kind { kCamera, kParallel };

  /// T_view_frame takes points to right, down, forward of whoever looks [m]. Before fit() one metre, at 1 m
  /// from a camera, is one pixel.
  Projection(Kind kind, const Eigen::Isometry3f& T_view_frame) : kind_(kind), T_view_frame_(T_view_frame) {}

  /// Shifts and magnifies so that these points and a margin just fit, but for this share of them on each
  /// side.
  void fit(std::span<const Eigen::Vector3f> points, float left_out, int width, int height);

  /// Nothing for what is behind a camera. towards_viewer_m: as if it were so much nearer.
  [[nodiscard]] std::optional<Projected> project(const Eigen::Vector3f& point,
                                                 float towards_viewer_m = 0) const;

  /// [m] along the line of sight.
  [[nodiscard]] float depth_of(float nearness) const {
    return kind_ == Kind::kCamera ? 1 / nearness : -nearness;
  }
  [[nodiscard]] float pixels_per_m(float depth_m) const {
    return kind_ == Kind::kCamera ? scale_ / depth_m : scale_;
  }
  [[nodiscard]] Kind kind() const { return kind_; }

 private:
  [[nodiscard]] Eigen::Vector2f flat(const Eigen::Vector3f& in_view) const;

  Kind kind_;
  Eigen::Isometry3f T_view_frame_;
  float scale_ = 1;
  Eigen::Vector2f offset_ = Eigen::Vector2f::Zero();
};

/// Takes points to right, down, forward of one at `position` who looks along `forward`; `up` is up in the
/// picture unless it is along the line of sight.
[[nodiscard]] Eigen::Isometry3f looking(const Eigen::Vector3f& position, const Eigen::Vector3f& forward,
                                        const Eigen::Vector3f& up);

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The largest plane that nothing is seen through: RANSAC over points and normals.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <optional>

#include "service/pipeline/coarse_surface.hpp"
#include "service/pipeline/raw_vector.hpp"
#include "service/pipeline/support.hpp"

namespace graspd {

/// What makes a point one of a plane's.
struct PlaneLimits {
  float thickness_m;  ///< it is nearer to the plane
  float min_cosine;   ///< between its normal and the plane's
};

/// How densely points at a distance [m] are sampled, 1 where all are alike. Far away by the part of the view
/// that a piece of surface fills, but for the slant: a wall behind a table may be larger than it.
[[nodiscard]] inline float sample_weight(float distance_m) {
  constexpr float kFar = 1;  // [m]
  const float d = std::max(kFar, distance_m);
  return 1 / (d * d);
}

/// Of each point above the plane [m], to the bit as Plane::height() has it.
[[nodiscard]] RawVector<float> heights_above(const Plane& plane, const PointCloud& cloud);

/// Of so many hypotheses the one with the most points on it less those seen through it: behind it, on lines
/// of sight that pass it where its own points are. A support hides what is behind it; beyond its border the
/// floor may be seen, however much of it. Its normal is on the side of the viewpoint. Nothing where every
/// plane is seen through as often as it has points.
/// Where the cloud is in the optical frame (x right, y down, z ahead) and the best plane faces down in the
/// image, as the back of a shelf does for a camera that stands upright, one that does not is enough with 0.4
/// of its score.
[[nodiscard]] std::optional<Plane> find_plane(CoarseSurface& coarse, int num_hypotheses,
                                              const PlaneLimits& limits, const Eigen::Vector3f& viewpoint);

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>

namespace graspd {

struct Plane {
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();  ///< unit length, towards the sensor
  float offset_m = 0;                                 ///< normal . p + offset_m = 0 for points of the plane

  /// Signed distance, positive on the sensor's side [m].
  [[nodiscard]] float height(const Eigen::Vector3f& p) const { return normal.dot(p) + offset_m; }
};

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Smoothing for noisy sensors: every point moves along its normal to the plane of its neighbourhood.
#pragma once
#include "service/pipeline/neighborhoods.hpp"
#include "service/pipeline/normals.hpp"
#include "service/pipeline/point_cloud.hpp"

namespace graspd {

struct SmoothingConfig {
  int iterations = 0;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& v) {
    v("iterations", self.iterations, Range{0, 20},
      "0: no smoothing; each moves points by at most half the neighbourhood's radius");
  }
};

/// One iteration. Neighbours whose normal differs by more than 25 degrees do not count; points with more than
/// a fifth of those, near edges, stay where they are, and so do points without a normal.
[[nodiscard]] PointCloud smooth(const PointCloud& cloud, const Normals& normals,
                                const Neighborhoods& neighborhoods);

}  // namespace graspd

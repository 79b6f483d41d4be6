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
  float from_scatter_m = 0.002f;
  float scatter_step_m = 0.0006f;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& v) {
    v("iterations", self.iterations, Range{0, 20},
      "at least so many; each moves points by at most half the neighbourhood's radius");
    v("from_scatter_m", self.from_scatter_m, Range{0, 1},
      "one at least where the support's points scatter this much about its plane; 0: never for that [m]");
    v("scatter_step_m", self.scatter_step_m, Range{0.0001, 1},
      "and one more, up to four, for each so much beyond it [m]");
  }
};

/// How many iterations a frame gets. scatter_m: root mean square distance of the support's points from its
/// plane, 0 where there is none: sensors' noise grows with the distance, and what little there is of it at a
/// good one is better left alone, as edges are rounded with it.
[[nodiscard]] int smoothing_iterations(const SmoothingConfig& config, float scatter_m);

/// One iteration. Neighbours whose normal differs by more than 25 degrees do not count; points with more than
/// a fifth of those, near edges, stay where they are, and so do points without a normal.
[[nodiscard]] PointCloud smooth(const PointCloud& cloud, const Normals& normals,
                                const Neighborhoods& neighborhoods);

}  // namespace graspd

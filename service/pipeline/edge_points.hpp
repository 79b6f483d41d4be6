// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Edge points: where many normals of the neighbourhood point elsewhere (paper, Definition 1).
#pragma once
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "service/pipeline/neighborhoods.hpp"
#include "service/pipeline/normals.hpp"

namespace graspd {

/// The two thresholds on the angle between normals (paper, section 4.1) and the share k of Definition 1.
struct SmoothnessConfig {
  float theta_low_deg = 4.0f;
  float theta_high_deg = 15.0f;
  float edge_share = 0.2f;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& v) {
    v("theta_low_deg", self.theta_low_deg, Range{0, 90},
      "theta_low: below this angle between normals neighbours are one surface [degrees]");
    v("theta_high_deg", self.theta_high_deg, Range{0, 90},
      "theta_high: above it they are not; between the two only away from edges [degrees]; equal: a single "
      "threshold");
    v("edge_share", self.edge_share, Range{0, 1},
      "k: an edge point has more than this share of its neighbourhood above theta_high");
  }

  /// theta_low_deg at most theta_high_deg.
  [[nodiscard]] std::optional<ConfigProblem> validate() const;
};

/// 1 for each edge point, else 0. Points without a normal are edge points.
[[nodiscard]] std::pmr::vector<std::uint8_t> find_edge_points(const Normals& normals,
                                                              const Neighborhoods& neighborhoods,
                                                              const SmoothnessConfig& config);

}  // namespace graspd

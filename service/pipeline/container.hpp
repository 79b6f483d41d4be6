// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The walls of a bin or box that objects lie in: like the support they are no objects, but in the way.
#pragma once
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "service/pipeline/segments.hpp"
#include "service/pipeline/support.hpp"

namespace graspd {

struct ContainerConfig {
  bool enabled = true;
  float min_length_m = 0.25f;
  float min_height_m = 0.05f;
  float thickness_m = 0.012f;
  float max_outside_share = 0.03f;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& v) {
    v("enabled", self.enabled, Range{}, "look for the walls of a bin around the objects");
    v("min_length_m", self.min_length_m, Range{0.05, 5}, "shortest wall, along the support [m]");
    v("min_height_m", self.min_height_m, Range{0.01, 2}, "lowest wall, above the support [m]");
    v("thickness_m", self.thickness_m, Range{0.001, 0.1},
      "points this close to a wall's face belong to it [m]");
    v("max_outside_share", self.max_outside_share, Range{0, 1},
      "share of the points above the support that may lie beyond a wall");
  }
};

/// 1 for each point that belongs to a wall; empty where there is no container. Walls are upright faces as
/// long and as high as configured that have what stands on the support on one side only; it takes two of
/// them, across or facing each other, to make a container.
[[nodiscard]] std::pmr::vector<std::uint8_t> find_container(const PointCloud& cloud, const Segments& segments,
                                                            const Support& support,
                                                            const ContainerConfig& config);

}  // namespace graspd

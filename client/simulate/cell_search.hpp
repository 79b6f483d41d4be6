// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Finds out what values a field takes in a box where the field changes no faster than distance does.
#pragma once
#include <Eigen/Geometry>
#include <vector>

namespace graspd {

/// Whether field(point) is below level somewhere in the box. The field must differ between two points by no
/// more than their distance, as signed distances do; cells smaller than finest are not looked into, so that
/// values above level - finest may be missed.
template <class Field>
[[nodiscard]] bool falls_below(const Field& field, const Eigen::AlignedBox3d& box, double level,
                               double finest) {
  struct Cell {
    Eigen::Vector3d center, half;
  };
  std::vector<Cell> cells{{box.center(), 0.5 * box.sizes()}};
  while (!cells.empty()) {
    Cell cell = cells.back();
    cells.pop_back();
    const double value = field(cell.center);
    if (value < level) return true;
    const double radius = cell.half.norm();
    if (value - radius >= level || radius < finest) continue;
    Eigen::Index longest = 0;
    cell.half.maxCoeff(&longest);
    cell.half[longest] *= 0.5;
    for (const double side : {-1.0, 1.0}) {
      Cell part = cell;
      part.center[longest] += side * cell.half[longest];
      cells.push_back(part);
    }
  }
  return false;
}

}  // namespace graspd

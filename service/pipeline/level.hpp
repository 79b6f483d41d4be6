// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// One of several surfaces at different heights that objects stand on: boards of a shelf, a step on a table.
#pragma once
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "service/pipeline/plane.hpp"
#include "service/pipeline/point_cloud.hpp"

namespace graspd {

/// Where on a plane its points are, in square cells: the largest part of them that hangs together, and what
/// it goes around, hidden by things on it.
class LevelExtent {
 public:
  /// points: those of the cloud on the plane, so far apart.
  LevelExtent(const PointCloud& cloud, std::span<const std::uint32_t> points, const Plane& plane,
              float spacing_m);

  /// Whether a point's foot is no farther than so many cells, 0 to kMostCells, from the extent.
  [[nodiscard]] bool covers(const Eigen::Vector3f& p, int cells) const;
  /// Of the part that is seen.
  [[nodiscard]] float area_m2() const { return area_m2_; }
  /// The smaller side of the upright rectangle around it, along the axes that its cells spread along [m].
  [[nodiscard]] float width_m() const { return width_m_; }

  static constexpr int kMostCells = 3;

 private:
  [[nodiscard]] std::optional<std::size_t> cell_of(const Eigen::Vector2f& place) const;
  void keep_largest_part();
  void measure_width();
  void fill_gaps();
  void mark_surroundings();

  Eigen::Vector3f u_, v_;
  float cell_m_;
  Eigen::Vector2f low_ = Eigen::Vector2f::Zero();
  std::size_t columns_ = 0, rows_ = 0;
  std::pmr::vector<std::uint8_t> distance_;  // in cells, plus one; 0: farther than kMostCells
  float area_m2_ = 0, width_m_ = 0;
};

struct Level {
  Plane plane;
  LevelExtent extent;
  bool is_solid = false;  ///< nothing is seen under it: rather a block than a board

  /// Whether the straight way from one point to another goes through the surface, from either side, or begins
  /// or ends in what is solid.
  [[nodiscard]] bool blocks(const Eigen::Vector3f& from, const Eigen::Vector3f& to) const;
};

/// Which of the levels, the lowest first, something stands on: the highest one that is not above its lowest
/// point and covers its middle; else the lowest one.
[[nodiscard]] std::uint32_t level_under(std::span<const Level> levels, const Eigen::Vector3f& middle,
                                        const Eigen::Vector3f& lowest);

}  // namespace graspd

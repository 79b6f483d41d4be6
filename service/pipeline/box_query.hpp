// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Points of a cloud inside an oriented box, in the box's own coordinates: what the gripper's volumes are
// tested with.
#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "service/pipeline/cell_order.hpp"
#include "service/pipeline/point_cloud.hpp"

namespace graspd {

/// Points in gripper coordinates [m]: a along the major axis, f along the closing axis, z along the approach.
/// Kept from query to query, so that its memory is.
class LocalPoints {
 public:
  std::span<float> a, f, z;
  std::span<std::uint32_t> index;  ///< into the cloud

  LocalPoints() = default;
  LocalPoints(LocalPoints&&) = default;
  LocalPoints& operator=(LocalPoints&&) = default;

  [[nodiscard]] std::size_t size() const { return a.size(); }
  [[nodiscard]] BandPoints band() const { return {f.data(), z.data(), index.data(), size()}; }
  void clear() { show(0); }
  /// spans: parts of the points to look at.
  void add_inside(const BoxTest& box, const PointRange& points, std::span<const PointSpan> spans);

 private:
  void show(std::size_t n);

  std::pmr::vector<float> a_, f_, z_;  // with room for what the kernels write beyond the points
  std::pmr::vector<std::uint32_t> index_;
};

/// Points whose coordinates rotation^T (p - origin) lie in [min, max] are inside.
[[nodiscard]] BoxTest box_test(const Eigen::Vector3f& origin, const Eigen::Matrix3f& rotation,
                               const Eigen::Vector3f& min, const Eigen::Vector3f& max);

class BoxQuery {
 public:
  BoxQuery() = default;
  /// All points must be finite. cell_m: side of the grid's cells, about a third of the boxes asked for.
  BoxQuery(const PointCloud& cloud, float cell_m) : BoxQuery(cloud, order_by_cell(cloud, cell_m)) {}
  BoxQuery(const PointCloud& cloud, const CellOrder& order);

  /// Points whose coordinates rotation^T (p - origin) lie in [min, max], in an order fixed by their
  /// positions. Replaces what is in out.
  void find(const Eigen::Vector3f& origin, const Eigen::Matrix3f& rotation, const Eigen::Vector3f& min,
            const Eigen::Vector3f& max, LocalPoints& out) const;

  /// Whether more than limit points lie in the box.
  [[nodiscard]] bool has_more(const Eigen::Vector3f& origin, const Eigen::Matrix3f& rotation,
                              const Eigen::Vector3f& min, const Eigen::Vector3f& max, int limit) const;

 private:
  struct Box;
  /// Calls visit(spans) with parts of the points that hold all those of the box; it returns false to stop.
  template <class Visit>
  void for_each_part(const Box& box, Visit visit) const;

  float cell_m_ = 1;
  /// Rows are cells with the same y and z that follow one another along x with small gaps; sorted by z, y and
  /// x. By row, and kPointPadding more:
  std::pmr::vector<std::int32_t> row_y_, row_x_, row_cells_;  // x of the first cell, number of cells
  std::pmr::vector<std::uint32_t> row_start_;                 // of its cells, in cell_starts_
  struct Layer {
    int z;
    std::size_t row;  ///< its first
  };
  std::pmr::vector<Layer> layers_;  // those that have rows; one more at the end
  std::pmr::vector<std::uint32_t>
      cell_starts_;  // for each x of each row, and for the one after: position in points_
  PaddedPoints points_;
};

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Points sorted by the cell of a regular grid they lie in: the one spatial index of the pipeline.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "service/pipeline/point_cloud.hpp"
#include "service/pipeline/point_kernels.hpp"
#include "service/pipeline/raw_vector.hpp"

namespace graspd {

/// Cells are cubes of side cell_m, aligned to the origin of the cloud's frame, numbered row by row: the
/// neighbours of a cell along x have the keys next to its own, and no neighbour of an occupied cell wraps to
/// another row.
struct CellKeys {
  float cell_m = 1;
  Eigen::Vector3i min_cell =
      Eigen::Vector3i::Zero();   ///< one less than the smallest occupied cell on each axis
  std::int64_t row = 1;          ///< from one key to the same x in the next row along y
  std::int64_t layer = 1;        ///< and in the next layer along z
  RawVector<std::int64_t> keys;  ///< of the occupied cells, ascending

  [[nodiscard]] std::size_t num_cells() const { return keys.size(); }
  [[nodiscard]] std::int64_t key(const Eigen::Vector3i& cell) const {
    return (cell.x() - min_cell.x()) + row * (cell.y() - min_cell.y()) + layer * (cell.z() - min_cell.z());
  }
  [[nodiscard]] Eigen::Vector3i cell_of(std::int64_t key) const {
    const std::int64_t z = key / layer, y = key % layer / row, x = key % row;
    return min_cell + Eigen::Vector3i(static_cast<int>(x), static_cast<int>(y), static_cast<int>(z));
  }
};

struct CellOrder : CellKeys {
  RawVector<std::uint32_t> points;  ///< indices into the cloud, sorted by key; stable
  RawVector<std::uint32_t> starts;  ///< keys.size() + 1 positions in points where a cell begins

  [[nodiscard]] std::span<const std::uint32_t> cell(std::size_t c) const {
    return {points.data() + starts[c], points.data() + starts[c + 1]};
  }
  /// Cells [begin, end) of the cloud that the order is of.
  [[nodiscard]] CellPoints of(const PointCloud& cloud, std::size_t begin, std::size_t end) const {
    return {cloud.x.data(), cloud.y.data(),        cloud.z.data(),
            points.data(),  starts.data() + begin, end - begin};
  }
};

/// All points must be finite, and the cloud's extent less than 2^20 cells on each axis.
[[nodiscard]] CellOrder order_by_cell(const PointCloud& cloud, float cell_m);

/// The order of the points with these indices alone; those of a cell are in the order of the indices.
[[nodiscard]] CellOrder order_by_cell(const PointCloud& cloud, std::span<const std::uint32_t> indices,
                                      float cell_m);

/// The order of the same points once they have been put into it.
[[nodiscard]] CellOrder in_order(CellOrder order);

/// The points of a cloud in their own order, without indices.
[[nodiscard]] inline PointRange range_of(const PointCloud& cloud) {
  return {cloud.x.data(), cloud.y.data(), cloud.z.data(), nullptr, cloud.size()};
}

/// The points with these indices, as an unorganized cloud.
[[nodiscard]] PointCloud points_at(const PointCloud& cloud, std::span<const std::uint32_t> indices);

/// Points of a cloud in an order of one's own, for the kernels.
class PaddedPoints {
 public:
  PaddedPoints() = default;
  /// order: indices into the cloud.
  PaddedPoints(const PointCloud& cloud, std::span<const std::uint32_t> order);

  [[nodiscard]] std::size_t size() const { return x_.size() - kPointPadding; }
  /// Those at positions [from, to) of the order.
  [[nodiscard]] PointRange range(std::size_t from, std::size_t to) const {
    return {x_.data() + from, y_.data() + from, z_.data() + from, index_.data() + from, to - from};
  }
  [[nodiscard]] PointRange all() const { return range(0, size()); }

 private:
  RawVector<float> x_, y_, z_;
  RawVector<std::uint32_t> index_;
};

}  // namespace graspd

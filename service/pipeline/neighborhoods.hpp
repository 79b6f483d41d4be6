// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The neighbourhood N(s) of every point (paper, equation 1), computed once for normals, edge points and
// growing.
#pragma once
#include <cstdint>
#include <memory_resource>
#include <span>
#include <utility>
#include <vector>

#include "service/pipeline/cell_order.hpp"
#include "service/pipeline/config_fields.hpp"
#include "service/pipeline/point_cloud.hpp"
#include "service/pipeline/raw_vector.hpp"

namespace graspd {

struct NeighborhoodsConfig {
  float radius_m = 0.009f;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& v) {
    v("radius_m", self.radius_m, Range{0.001, 0.3}, "r: radius of the neighbourhood of a point [m]");
  }
};

/// For each point the indices of all points within the radius, itself included; for skipped points none. The
/// kernels may read kPointPadding indices beyond the end of each list.
class Neighborhoods {
 public:
  using Storage = std::pmr::vector<RawVector<std::uint32_t>>;

  Neighborhoods() = default;
  /// points: those that are not skipped, ascending; lists: of every point, empty ones of those that are;
  /// storage: what the lists are in.
  Neighborhoods(RawVector<std::uint32_t> points, RawVector<NeighborList> lists, Storage storage)
      : points_(std::move(points)), lists_(std::move(lists)), storage_(std::move(storage)) {}

  [[nodiscard]] std::size_t size() const { return lists_.size(); }
  /// Those that are not skipped, ascending.
  [[nodiscard]] std::span<const std::uint32_t> points() const { return points_; }
  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t point) const {
    return {lists_[point].indices, lists_[point].size};
  }
  [[nodiscard]] const NeighborList& list(std::size_t point) const { return lists_[point]; }

 private:
  RawVector<std::uint32_t> points_;
  RawVector<NeighborList> lists_;
  Storage storage_;
};

/// All points must be finite. The order within a list is fixed by the points' positions. skip: 1 for each
/// point whose own neighbourhood is not wanted (it still is a neighbour of others); may be empty.
[[nodiscard]] Neighborhoods find_neighborhoods(const PointCloud& cloud, const NeighborhoodsConfig& config,
                                               const std::pmr::vector<std::uint8_t>& skip = {});

/// Of a cloud with one point in each cell, in the cells' order: a point's neighbours are those of the 26
/// cells around its own. Coarser than a radius, and found without a distance.
[[nodiscard]] Neighborhoods adjacent_points(const CellKeys& cells,
                                            const std::pmr::vector<std::uint8_t>& skip = {});

}  // namespace graspd

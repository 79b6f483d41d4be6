// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/neighborhoods.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

namespace graspd {
namespace {

/// Points of several ranges one after the other.
class GatheredPoints {
 public:
  void clear() { size_ = 0; }
  void add(const PointRange& range) {
    if (const std::size_t most = size_ + range.size + kPointPadding; x_.size() < most) {
      const std::size_t room = std::max(most, 2 * x_.size());
      for (RawVector<float>* v : {&x_, &y_, &z_}) v->resize(room);
      index_.resize(room);
    }
    const std::size_t n = range.size + kPointPadding;  // the padding of the last range is the padding of all
    std::copy_n(range.x, n, x_.data() + size_);
    std::copy_n(range.y, n, y_.data() + size_);
    std::copy_n(range.z, n, z_.data() + size_);
    std::copy_n(range.index, n, index_.data() + size_);
    size_ += range.size;
  }
  [[nodiscard]] PointRange all() const { return {x_.data(), y_.data(), z_.data(), index_.data(), size_}; }

 private:
  RawVector<float> x_, y_, z_;
  RawVector<std::uint32_t> index_;
  std::size_t size_ = 0;
};

/// The nine rows of three cells around a cell. Keys ascend from cell to cell, so that each row's position
/// only moves on.
class RowCursor {
 public:
  RowCursor(const CellOrder& order, const PaddedPoints& points, std::size_t first_cell)
      : order_(order), points_(points) {
    std::size_t i = 0;
    for (std::int64_t dz = -1; dz <= 1; ++dz)
      for (std::int64_t dy = -1; dy <= 1; ++dy) offsets_[i++] = dz * order.layer + dy * order.row;
    for (i = 0; i < offsets_.size(); ++i) {
      const std::int64_t key = order.keys[first_cell] + offsets_[i] - 1;
      positions_[i] = static_cast<std::size_t>(std::lower_bound(order.keys.begin(), order.keys.end(), key) -
                                               order.keys.begin());
    }
  }

  /// Gathers the points around a cell; cells must ascend from call to call.
  void move_to(std::size_t cell) {
    around_.clear();
    for (std::size_t i = 0; i < offsets_.size(); ++i) {
      const std::int64_t center = order_.keys[cell] + offsets_[i];
      std::size_t& p = positions_[i];
      while (p < order_.num_cells() && order_.keys[p] < center - 1) ++p;
      std::size_t end = p;
      while (end < order_.num_cells() && order_.keys[end] <= center + 1) ++end;
      if (p != end) around_.add(points_.range(order_.starts[p], order_.starts[end]));
    }
  }

  [[nodiscard]] PointRange around() const { return around_.all(); }

 private:
  const CellOrder& order_;
  const PaddedPoints& points_;
  std::array<std::int64_t, 9> offsets_{};
  std::array<std::size_t, 9> positions_{};
  GatheredPoints around_;
};

/// The points of a cell whose neighbourhoods are wanted.
void wanted_points(std::span<const std::uint32_t> cell, const std::pmr::vector<std::uint8_t>& skip,
                   std::pmr::vector<std::uint32_t>& wanted) {
  wanted.clear();
  for (const std::uint32_t i : cell)
    if (skip.empty() || !skip[i]) wanted.push_back(i);
}

}  // namespace

NeighborhoodSearch::NeighborhoodSearch(const PointCloud& cloud, const NeighborhoodsConfig& config)
    : cloud_(cloud),
      radius_m_(config.radius_m),
      order_(order_by_cell(cloud, config.radius_m)),
      points_(cloud, order_.points) {}

Neighborhoods NeighborhoodSearch::find(const std::pmr::vector<std::uint8_t>& skip) const {
  Neighborhoods result;
  result.lists_.resize(cloud_.size());
  constexpr std::size_t kCellsPerChunk = 128;
  const std::size_t num_chunks = (order_.num_cells() + kCellsPerChunk - 1) / kCellsPerChunk;
  result.storage_.resize(num_chunks);
  const float radius_squared = radius_m_ * radius_m_;
  const PointKernels& kernels = point_kernels();

  tbb::parallel_for(std::size_t{0}, num_chunks, [&](std::size_t chunk) {
    const std::size_t begin = chunk * kCellsPerChunk;
    const std::size_t end = std::min(begin + kCellsPerChunk, order_.num_cells());
    RowCursor cursor(order_, points_, begin);
    RawVector<std::uint32_t>& list = result.storage_[chunk];
    std::pmr::vector<std::uint32_t> wanted, done;
    std::pmr::vector<std::size_t> ends{0};
    for (std::size_t c = begin; c < end; ++c) {
      wanted_points(order_.cell(c), skip, wanted);
      if (wanted.empty()) continue;
      cursor.move_to(c);
      const PointRange around = cursor.around();
      const std::size_t most = wanted.size() * around.size + kPointPadding;
      if (list.size() < ends.back() + most) list.resize(std::max(2 * list.size(), ends.back() + most));
      for (const std::uint32_t i : wanted) {
        const std::size_t from = ends.back();
        done.push_back(i);
        ends.push_back(from + kernels.keep_near({cloud_.x[i], cloud_.y[i], cloud_.z[i]}, radius_squared,
                                                around, list.data() + from));
      }
    }
    if (!list.empty()) std::fill_n(list.data() + ends.back(), kPointPadding, 0u);
    // Only now, because the list moves while it grows.
    for (std::size_t k = 0; k < done.size(); ++k)
      result.lists_[done[k]] = {list.data() + ends[k], list.data() + ends[k + 1]};
  });
  return result;
}

Neighborhoods find_neighborhoods(const PointCloud& cloud, const NeighborhoodsConfig& config,
                                 const std::pmr::vector<std::uint8_t>& skip) {
  return NeighborhoodSearch(cloud, config).find(skip);
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/neighborhoods.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "service/pipeline/cell_order.hpp"

namespace graspd {
namespace {

/// Points that can be neighbours of those in one cell, copied together so that distances run over plain
/// arrays.
struct Candidates {
  std::vector<float> x, y, z;
  std::vector<std::uint32_t> point;
  std::vector<float> distance;       // squared, to the point that neighbours are looked for
  std::vector<std::uint32_t> found;  // those within the radius

  void clear() {
    x.clear();
    y.clear();
    z.clear();
    point.clear();
  }
  void add(const PointCloud& cloud, std::uint32_t i) {
    x.push_back(cloud.x[i]);
    y.push_back(cloud.y[i]);
    z.push_back(cloud.z[i]);
    point.push_back(i);
  }
};

/// The nine rows of three cells around a cell. Keys ascend from cell to cell, so that each row's position
/// only moves on.
class RowCursor {
 public:
  RowCursor(const CellOrder& order, std::size_t first_cell) : order_(order) {
    std::size_t i = 0;
    for (std::int64_t dz = -1; dz <= 1; ++dz)
      for (std::int64_t dy = -1; dy <= 1; ++dy) offsets_[i++] = dz * order.layer + dy * order.row;
    for (i = 0; i < offsets_.size(); ++i) {
      const std::int64_t key = order.keys[first_cell] + offsets_[i] - 1;
      positions_[i] = std::lower_bound(order.keys.begin(), order.keys.end(), key) - order.keys.begin();
    }
  }

  /// Collects the points around a cell; cells must ascend from call to call.
  void collect(const PointCloud& cloud, std::size_t cell, Candidates& out) {
    out.clear();
    const auto end = static_cast<std::ptrdiff_t>(order_.num_cells());
    for (std::size_t i = 0; i < offsets_.size(); ++i) {
      const std::int64_t center = order_.keys[cell] + offsets_[i];
      std::ptrdiff_t& p = positions_[i];
      while (p < end && order_.keys[static_cast<std::size_t>(p)] < center - 1) ++p;
      for (std::ptrdiff_t c = p; c < end && order_.keys[static_cast<std::size_t>(c)] <= center + 1; ++c)
        for (const std::uint32_t point : order_.cell(static_cast<std::size_t>(c))) out.add(cloud, point);
    }
  }

 private:
  const CellOrder& order_;
  std::array<std::int64_t, 9> offsets_{};
  std::array<std::ptrdiff_t, 9> positions_{};
};

/// Appends to the list all candidates within the radius of a point. The distances have a loop of their own,
/// because the compiler can use vectors for that one alone.
void append_neighbors(const Eigen::Vector3f& s, float radius_squared, Candidates& candidates,
                      std::vector<std::uint32_t>& list) {
  const std::size_t n = candidates.point.size();
  candidates.distance.resize(n);
  candidates.found.resize(n);
  const float sx = s.x(), sy = s.y(), sz = s.z();
  const float *x = candidates.x.data(), *y = candidates.y.data(), *z = candidates.z.data();
  float* distance = candidates.distance.data();
  for (std::size_t j = 0; j < n; ++j) {
    const float dx = x[j] - sx, dy = y[j] - sy, dz = z[j] - sz;
    distance[j] = dx * dx + dy * dy + dz * dz;
  }
  const std::uint32_t* point = candidates.point.data();
  std::uint32_t *begin = candidates.found.data(), *end = begin;
  for (std::size_t j = 0; j < n; ++j) {
    *end = point[j];
    end += distance[j] <= radius_squared ? 1 : 0;
  }
  list.insert(list.end(), begin, end);
}

/// The points of a cell whose neighbourhoods are wanted.
void wanted_points(std::span<const std::uint32_t> cell, const std::vector<std::uint8_t>& skip,
                   std::vector<std::uint32_t>& wanted) {
  wanted.clear();
  for (const std::uint32_t i : cell)
    if (skip.empty() || !skip[i]) wanted.push_back(i);
}

}  // namespace

Neighborhoods find_neighborhoods(const PointCloud& cloud, const NeighborhoodsConfig& config,
                                 const std::vector<std::uint8_t>& skip) {
  Neighborhoods result;
  result.lists_.resize(cloud.size());
  const CellOrder order = order_by_cell(cloud, config.radius_m);
  constexpr std::size_t kCellsPerChunk = 128;
  const std::size_t num_chunks = (order.num_cells() + kCellsPerChunk - 1) / kCellsPerChunk;
  result.storage_.resize(num_chunks);
  const float radius_squared = config.radius_m * config.radius_m;

  tbb::parallel_for(std::size_t{0}, num_chunks, [&](std::size_t chunk) {
    const std::size_t begin = chunk * kCellsPerChunk;
    const std::size_t end = std::min(begin + kCellsPerChunk, order.num_cells());
    RowCursor rows(order, begin);
    Candidates candidates;
    std::vector<std::uint32_t>& list = result.storage_[chunk];
    std::vector<std::uint32_t> wanted, done;
    std::vector<std::size_t> ends;
    for (std::size_t c = begin; c < end; ++c) {
      wanted_points(order.cell(c), skip, wanted);
      if (wanted.empty()) continue;
      rows.collect(cloud, c, candidates);
      for (const std::uint32_t i : wanted) {
        append_neighbors(cloud.point(i), radius_squared, candidates, list);
        done.push_back(i);
        ends.push_back(list.size());
      }
    }
    // Only now, because the list moves while it grows.
    std::size_t first = 0;
    for (std::size_t k = 0; k < done.size(); ++k) {
      result.lists_[done[k]] = {list.data() + first, list.data() + ends[k]};
      first = ends[k];
    }
  });
  return result;
}

}  // namespace graspd

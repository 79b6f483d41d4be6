// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/cell_order.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <utility>

#include "service/pipeline/cell_runs.hpp"

namespace graspd {
namespace {

template <class Key>
void set_cells(const RawVector<CellRun<Key>>& runs, CellOrder& order) {
  constexpr bool kHasKernels = sizeof(Key) == sizeof(std::uint32_t);
  const std::size_t n = runs.size();
  std::pmr::vector<CellCounts> begins((n + kPart - 1) / kPart);  // first what is in each part
  for_each_part(n, [&](std::size_t p, std::size_t begin, std::size_t end) {
    if constexpr (kHasKernels)
      begins[p] = point_kernels().count_cells(runs.data(), begin, end);
    else
      begins[p] = count_cells(runs.data(), begin, end);
  });
  CellCounts sum;
  for (CellCounts& begin : begins) {
    const CellCounts size = std::exchange(begin, sum);
    sum = {sum.cells + size.cells, sum.points + size.points};
  }
  begins.push_back(sum);
  order.points.resize(sum.points);
  order.keys.resize(sum.cells);
  order.starts.resize(sum.cells + 1);
  for_each_part(n, [&](std::size_t p, std::size_t begin, std::size_t end) {
    const CellCounts &from = begins[p], &to = begins[p + 1];
    const CellOutput out{order.keys.data() + from.cells,
                         order.starts.data() + from.cells,
                         order.points.data(),
                         to.cells - from.cells,
                         from.points,
                         to.points};
    if constexpr (kHasKernels)
      point_kernels().write_cells(runs.data(), begin, end, out);
    else
      write_cells(runs.data(), begin, end, out);
  });
  order.starts.back() = sum.points;
}

/// Number of cells on an axis, with one to spare at either end; min: the first.
int cell_range(const RawVector<float>& v, float per_cell, int& min) {
  float low = v.front(), high = v.front();
  point_kernels().extend_bounds(v.data(), v.size(), low, high);
  min = cell_index(low, per_cell) - 1;
  return cell_index(high, per_cell) + 2 - min;
}

/// Number of each point's cell.
template <class Key>
RawVector<Key> number_cells(const PointCloud& cloud, float per_cell, const CellKeys& order) {
  RawVector<Key> keys(cloud.size());
  const CellGrid grid{per_cell,
                      {order.min_cell.x(), order.min_cell.y(), order.min_cell.z()},
                      static_cast<std::uint32_t>(order.row),
                      static_cast<std::uint32_t>(order.layer)};
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cloud.size(), 8192), [&](const auto& range) {
    const std::size_t begin = range.begin(), end = range.end();
    if constexpr (sizeof(Key) == sizeof(std::uint32_t))
      point_kernels().number_cells(grid, cloud.x.data() + begin, cloud.y.data() + begin,
                                   cloud.z.data() + begin, end - begin, keys.data() + begin);
    else
      for (std::size_t i = begin; i < end; ++i)
        keys[i] =
            static_cast<Key>(order.key({cell_index(cloud.x[i], per_cell), cell_index(cloud.y[i], per_cell),
                                        cell_index(cloud.z[i], per_cell)}));
  });
  return keys;
}

template <class Key>
RawVector<CellRun<Key>> sorted_runs(const PointCloud& cloud, float per_cell, int num_bits,
                                    const CellKeys& order) {
  RawVector<CellRun<Key>> runs = find_runs(number_cells<Key>(cloud, per_cell, order));
  sort_by_key(runs, num_bits);
  return runs;
}

}  // namespace

CellOrder order_by_cell(const PointCloud& cloud, float cell_m) {
  CellOrder order;
  order.cell_m = cell_m;
  order.starts = {0};
  if (cloud.empty()) return order;
  const float per_cell = 1.0f / cell_m;
  Eigen::Vector3i& min = order.min_cell;
  order.row = cell_range(cloud.x, per_cell, min.x());
  order.layer = order.row * cell_range(cloud.y, per_cell, min.y());
  const std::int64_t num_keys = order.layer * cell_range(cloud.z, per_cell, min.z());
  const int num_bits = static_cast<int>(std::bit_width(static_cast<std::uint64_t>(num_keys)));
  if (num_bits <= 32 && cloud.size() <= CellRun<std::uint32_t>::kFirstEnd)
    set_cells(sorted_runs<std::uint32_t>(cloud, per_cell, num_bits, order), order);
  else
    set_cells(sorted_runs<std::uint64_t>(cloud, per_cell, num_bits, order), order);
  return order;
}

CellOrder order_by_cell(const PointCloud& cloud, std::span<const std::uint32_t> indices, float cell_m) {
  CellOrder order = order_by_cell(points_at(cloud, indices), cell_m);
  for (std::uint32_t& point : order.points) point = indices[point];
  return order;
}

CellOrder in_order(CellOrder order) {
  std::iota(order.points.begin(), order.points.end(), 0u);
  return order;
}

PaddedPoints::PaddedPoints(const PointCloud& cloud, std::span<const std::uint32_t> order)
    : x_(order.size() + kPointPadding),
      y_(order.size() + kPointPadding),
      z_(order.size() + kPointPadding),
      index_(order.size() + kPointPadding) {
  const PointRange points = range_of(cloud);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, order.size(), 16384), [&](const auto& range) {
    const std::size_t k = range.begin();
    point_kernels().copy_at(points, order.subspan(k, range.size()),
                            {x_.data() + k, y_.data() + k, z_.data() + k, index_.data() + k});
  });
  for (RawVector<float>* v : {&x_, &y_, &z_}) std::fill_n(v->end() - kPointPadding, kPointPadding, 0.0f);
  std::fill_n(index_.end() - kPointPadding, kPointPadding, 0u);
}

PointCloud points_at(const PointCloud& cloud, std::span<const std::uint32_t> indices) {
  PointCloud points = unorganized_cloud(indices.size(), cloud.viewpoint);
  point_kernels().copy_at(range_of(cloud), indices,
                          {points.x.data(), points.y.data(), points.z.data(), nullptr});
  return points;
}

}  // namespace graspd

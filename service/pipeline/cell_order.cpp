// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/cell_order.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "service/pipeline/cell_runs.hpp"

namespace graspd {
namespace {

/// Where a part of the sorted runs begins.
struct PartBegin {
  std::uint32_t cell = 0, point = 0;
};

/// Writes the points of runs [begin, end), and those cells that begin there.
template <class Key>
void set_part(const Runs<Key>& runs, std::size_t begin, std::size_t end, PartBegin at, CellOrder& order) {
  const Run<Key>* list = runs.list.data();
  std::uint32_t* points = order.points.data();
  std::int64_t* keys = order.keys.data();
  std::uint32_t* starts = order.starts.data();
  for (std::size_t r = begin; r < end; ++r) {
    if (r == 0 || list[r].key != list[r - 1].key) {
      keys[at.cell] = static_cast<std::int64_t>(list[r].key);
      starts[at.cell++] = at.point;
    }
    const std::uint32_t first = runs.starts[list[r].number], last = runs.starts[list[r].number + 1];
    for (std::uint32_t i = first; i < last; ++i) points[at.point++] = i;
  }
}

template <class Key>
void set_cells(const Runs<Key>& runs, CellOrder& order) {
  const std::size_t n = runs.list.size();
  std::pmr::vector<PartBegin> begins((n + kPart - 1) / kPart);
  for_each_part(n, [&](std::size_t p, std::size_t begin, std::size_t end) {
    PartBegin sum;
    for (std::size_t r = begin; r < end; ++r) {
      const std::uint32_t number = runs.list[r].number;
      sum.cell += r == 0 || runs.list[r].key != runs.list[r - 1].key ? 1 : 0;
      sum.point += runs.starts[number + 1] - runs.starts[number];
    }
    begins[p] = sum;
  });
  PartBegin sum;
  for (PartBegin& begin : begins) {
    const PartBegin size = std::exchange(begin, sum);
    sum = {sum.cell + size.cell, sum.point + size.point};
  }
  order.points.resize(sum.point);
  order.keys.resize(sum.cell);
  order.starts.resize(sum.cell + 1);
  for_each_part(n, [&](std::size_t p, std::size_t begin, std::size_t end) {
    set_part(runs, begin, end, begins[p], order);
  });
  order.starts.back() = sum.point;
}

template <class Key>
void set_cell_runs(const Runs<Key>& runs, CellRuns& cells) {
  const Run<Key>* list = runs.list.data();
  const std::size_t n = runs.list.size();
  std::pmr::vector<std::uint32_t> begins((n + kPart - 1) / kPart);
  for_each_part(n, [&](std::size_t p, std::size_t begin, std::size_t end) {
    std::uint32_t num = begin == 0 ? 1 : 0;
    for (std::size_t r = std::max<std::size_t>(1, begin); r < end; ++r)
      num += list[r].key != list[r - 1].key ? 1 : 0;
    begins[p] = num;
  });
  cells.runs.resize(n);
  cells.keys.resize(set_begins(begins));
  cells.starts.resize(cells.keys.size() + 1);
  for_each_part(n, [&](std::size_t p, std::size_t begin, std::size_t end) {
    const std::uint32_t* first = runs.starts.data();
    std::uint32_t* next = cells.starts.data() + begins[p];
    std::int64_t* keys = cells.keys.data() + begins[p];
    PointSpan* spans = cells.runs.data();
    for (std::size_t r = begin; r < end; ++r) {
      if (r == 0 || list[r].key != list[r - 1].key) {
        *next++ = static_cast<std::uint32_t>(r);
        *keys++ = static_cast<std::int64_t>(list[r].key);
      }
      spans[r] = {first[list[r].number], first[list[r].number + 1]};
    }
  });
  cells.starts.back() = static_cast<std::uint32_t>(n);
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
Runs<Key> sorted_runs(const PointCloud& cloud, float per_cell, int num_bits, const CellKeys& order) {
  Runs<Key> runs = find_runs(number_cells<Key>(cloud, per_cell, order));
  sort_by_key(runs.list, num_bits);
  return runs;
}

/// Sets where the grid lies, and calls use(runs) with the sorted runs of its cells. There must be points.
template <class Use>
void sort_into_cells(const PointCloud& cloud, float cell_m, CellKeys& order, Use use) {
  const float per_cell = 1.0f / cell_m;
  order.cell_m = cell_m;
  Eigen::Vector3i& min = order.min_cell;
  order.row = cell_range(cloud.x, per_cell, min.x());
  order.layer = order.row * cell_range(cloud.y, per_cell, min.y());
  const std::int64_t num_keys = order.layer * cell_range(cloud.z, per_cell, min.z());
  const int num_bits = static_cast<int>(std::bit_width(static_cast<std::uint64_t>(num_keys)));
  if (num_bits <= 32)
    use(sorted_runs<std::uint32_t>(cloud, per_cell, num_bits, order));
  else
    use(sorted_runs<std::uint64_t>(cloud, per_cell, num_bits, order));
}

}  // namespace

CellOrder order_by_cell(const PointCloud& cloud, float cell_m) {
  CellOrder order;
  if (cloud.empty()) {
    order.cell_m = cell_m;
    order.starts = {0};
    return order;
  }
  sort_into_cells(cloud, cell_m, order, [&order](const auto& runs) { set_cells(runs, order); });
  return order;
}

CellRuns runs_by_cell(const PointCloud& cloud, float cell_m) {
  CellRuns cells;
  if (cloud.empty()) {
    cells.cell_m = cell_m;
    cells.starts = {0};
    return cells;
  }
  sort_into_cells(cloud, cell_m, cells, [&cells](const auto& runs) { set_cell_runs(runs, cells); });
  return cells;
}

PaddedPoints::PaddedPoints(const PointCloud& cloud, std::span<const std::uint32_t> order)
    : x_(order.size() + kPointPadding),
      y_(order.size() + kPointPadding),
      z_(order.size() + kPointPadding),
      index_(order.size() + kPointPadding) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, order.size(), 8192), [&](const auto& range) {
    for (std::size_t k = range.begin(); k != range.end(); ++k) {
      const std::uint32_t i = order[k];
      x_[k] = cloud.x[i];
      y_[k] = cloud.y[i];
      z_[k] = cloud.z[i];
      index_[k] = i;
    }
  });
  pad();
}

PaddedPoints::PaddedPoints(const PointCloud& cloud, std::span<const PointSpan> runs, std::size_t num_points)
    : x_(num_points + kPointPadding),
      y_(num_points + kPointPadding),
      z_(num_points + kPointPadding),
      index_(num_points + kPointPadding) {
  const float *xs = cloud.x.data(), *ys = cloud.y.data(), *zs = cloud.z.data();
  float *x = x_.data(), *y = y_.data(), *z = z_.data();
  std::uint32_t* index = index_.data();
  const std::size_t last_block = cloud.size() < kPointPadding ? 0 : cloud.size() - kPointPadding + 1;
  for (const PointSpan& run : runs) {
    std::size_t i = run.begin, to = 0;
    // In blocks, of which the last one brings some of what follows in the cloud: the next run overwrites it.
    constexpr std::size_t kShort = 3;
    if (run.end - run.begin > kShort)
      for (; i < run.end && i < last_block; i += kPointPadding, to += kPointPadding) {
        std::memcpy(x + to, xs + i, kPointPadding * sizeof(float));
        std::memcpy(y + to, ys + i, kPointPadding * sizeof(float));
        std::memcpy(z + to, zs + i, kPointPadding * sizeof(float));
        for (std::size_t k = 0; k < kPointPadding; ++k) index[to + k] = static_cast<std::uint32_t>(i + k);
      }
    for (; i < run.end; ++i, ++to) {
      x[to] = xs[i];
      y[to] = ys[i];
      z[to] = zs[i];
      index[to] = static_cast<std::uint32_t>(i);
    }
    const std::size_t size = run.end - run.begin;
    x += size;
    y += size;
    z += size;
    index += size;
  }
  pad();
}

void PaddedPoints::pad() {
  for (RawVector<float>* v : {&x_, &y_, &z_}) std::fill_n(v->end() - kPointPadding, kPointPadding, 0.0f);
  std::fill_n(index_.end() - kPointPadding, kPointPadding, 0u);
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/cell_order.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace graspd {
namespace {

template <class Key>
struct Entry {
  Key key;
  std::uint32_t point;
};

/// How keys are taken apart for a radix sort.
struct Digits {
  int num_places, bits;

  explicit Digits(int num_bits) {
    constexpr int kMostBits = 13;  // counts of all values stay in the first-level cache
    num_places = std::max(1, (num_bits + kMostBits - 1) / kMostBits);
    bits = (num_bits + num_places - 1) / num_places;
  }
  [[nodiscard]] std::size_t num_values() const { return std::size_t{1} << bits; }
  template <class Key>
  [[nodiscard]] std::size_t at(Key key, int place) const {
    return static_cast<std::size_t>(key >> (place * bits)) & (num_values() - 1);
  }
};

/// The points by key; stable. Radix sort, least significant digit first, over the lowest num_bits.
template <class Key>
RawVector<Entry<Key>> sorted_by_key(const RawVector<Key>& keys, int num_bits) {
  const Digits digits(num_bits);
  RawVector<Entry<Key>> entries(keys.size()), sorted(digits.num_places > 1 ? keys.size() : 0);
  std::pmr::vector<std::uint32_t> next(digits.num_values());
  const auto count = [&](int place) {
    std::fill(next.begin(), next.end(), 0u);
    for (const Key key : keys) ++next[digits.at(key, place)];
    std::uint32_t sum = 0;
    for (std::uint32_t& n : next) sum += std::exchange(n, sum);
  };
  count(0);
  for (std::uint32_t i = 0; i < keys.size(); ++i) entries[next[digits.at(keys[i], 0)]++] = {keys[i], i};
  for (int place = 1; place < digits.num_places; ++place) {
    count(place);
    for (const Entry<Key>& e : entries) sorted[next[digits.at(e.key, place)]++] = e;
    entries.swap(sorted);
  }
  return entries;
}

template <class Key>
void set_cells(const RawVector<Entry<Key>>& entries, CellOrder& order) {
  const std::size_t n = entries.size();
  std::size_t num_cells = 1;
  for (std::size_t i = 1; i < n; ++i) num_cells += entries[i].key != entries[i - 1].key ? 1 : 0;
  order.points.resize(n);
  order.keys.resize(num_cells + 1);
  order.starts.resize(num_cells + 1);
  // Each point writes where the next cell would begin; those that begin none are overwritten.
  std::size_t c = 0;
  for (std::size_t i = 0; i < n; ++i) {
    order.points[i] = entries[i].point;
    order.keys[c] = static_cast<std::int64_t>(entries[i].key);
    order.starts[c] = static_cast<std::uint32_t>(i);
    c += i == 0 || entries[i].key != entries[i - 1].key ? 1 : 0;
  }
  order.keys.resize(num_cells);
  order.starts[num_cells] = static_cast<std::uint32_t>(n);
}

/// Number of cells on an axis, with one to spare at either end; min: the first.
int cell_range(const std::pmr::vector<float>& v, float per_cell, int& min) {
  float low = v.front(), high = v.front();
  point_kernels().extend_bounds(v.data(), v.size(), low, high);
  min = cell_index(low, per_cell) - 1;
  return cell_index(high, per_cell) + 2 - min;
}

/// Number of each point's cell.
template <class Key>
RawVector<Key> number_cells(const PointCloud& cloud, float per_cell, const CellOrder& order) {
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
void sort_into_cells(const PointCloud& cloud, float per_cell, int num_bits, CellOrder& order) {
  set_cells(sorted_by_key(number_cells<Key>(cloud, per_cell, order), num_bits), order);
}

}  // namespace

CellOrder order_by_cell(const PointCloud& cloud, float cell_m) {
  CellOrder order;
  order.cell_m = cell_m;
  if (cloud.empty()) {
    order.starts = {0};
    return order;
  }
  const float per_cell = 1.0f / cell_m;
  Eigen::Vector3i& min = order.min_cell;
  order.row = cell_range(cloud.x, per_cell, min.x());
  order.layer = order.row * cell_range(cloud.y, per_cell, min.y());
  const std::int64_t num_keys = order.layer * cell_range(cloud.z, per_cell, min.z());
  const int num_bits = static_cast<int>(std::bit_width(static_cast<std::uint64_t>(num_keys)));
  if (num_bits <= 32)
    sort_into_cells<std::uint32_t>(cloud, per_cell, num_bits, order);
  else
    sort_into_cells<std::uint64_t>(cloud, per_cell, num_bits, order);
  return order;
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
  for (RawVector<float>* v : {&x_, &y_, &z_}) std::fill_n(v->end() - kPointPadding, kPointPadding, 0.0f);
  std::fill_n(index_.end() - kPointPadding, kPointPadding, 0u);
}

}  // namespace graspd

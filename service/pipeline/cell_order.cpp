// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/cell_order.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

namespace graspd {
namespace {

struct Entry {
  std::uint64_t key;
  std::uint32_t point;
};

constexpr int kDigitBits = 11;
constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;

/// Stable least-significant-digit radix sort over the lowest num_bits of the keys.
void radix_sort(std::vector<Entry>& entries, int num_bits) {
  std::vector<Entry> sorted(entries.size());
  for (int shift = 0; shift < num_bits; shift += kDigitBits) {
    std::array<std::uint32_t, kDigits> next{};
    for (const Entry& e : entries) ++next[(e.key >> shift) & (kDigits - 1)];
    std::uint32_t sum = 0;
    for (std::uint32_t& n : next) sum += std::exchange(n, sum);
    for (const Entry& e : entries) sorted[next[(e.key >> shift) & (kDigits - 1)]++] = e;
    entries.swap(sorted);
  }
}

/// Number of cells on an axis, with one to spare at either end; min: the first.
int cell_range(const std::vector<float>& v, float per_cell, int& min) {
  // Side by side, because the compiler may not reorder comparisons of its own accord.
  constexpr std::size_t kLanes = 16;
  std::array<float, kLanes> low, high;
  low.fill(v.front());
  high.fill(v.front());
  std::size_t i = 0;
  for (; i + kLanes <= v.size(); i += kLanes)
    for (std::size_t k = 0; k < kLanes; ++k) {
      low[k] = std::min(low[k], v[i + k]);
      high[k] = std::max(high[k], v[i + k]);
    }
  for (; i < v.size(); ++i) {
    low[0] = std::min(low[0], v[i]);
    high[0] = std::max(high[0], v[i]);
  }
  min = cell_index(*std::min_element(low.begin(), low.end()), per_cell) - 1;
  return cell_index(*std::max_element(high.begin(), high.end()), per_cell) + 2 - min;
}

}  // namespace

CellOrder order_by_cell(const PointCloud& cloud, float cell_m) {
  CellOrder order;
  order.cell_m = cell_m;
  const std::size_t n = cloud.size();
  if (n == 0) {
    order.starts = {0};
    return order;
  }
  const float per_cell = 1.0f / cell_m;
  Eigen::Vector3i& min = order.min_cell;
  order.row = cell_range(cloud.x, per_cell, min.x());
  order.layer = order.row * cell_range(cloud.y, per_cell, min.y());
  const std::int64_t num_keys = order.layer * cell_range(cloud.z, per_cell, min.z());

  std::vector<Entry> entries(n);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, 8192), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const Eigen::Vector3i cell(cell_index(cloud.x[i], per_cell), cell_index(cloud.y[i], per_cell),
                                 cell_index(cloud.z[i], per_cell));
      entries[i] = {static_cast<std::uint64_t>(order.key(cell)), static_cast<std::uint32_t>(i)};
    }
  });
  radix_sort(entries, static_cast<int>(std::bit_width(static_cast<std::uint64_t>(num_keys))));

  order.points.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    order.points[i] = entries[i].point;
    const auto key = static_cast<std::int64_t>(entries[i].key);
    if (i == 0 || key != order.keys.back()) {
      order.keys.push_back(key);
      order.starts.push_back(static_cast<std::uint32_t>(i));
    }
  }
  order.starts.push_back(static_cast<std::uint32_t>(n));
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
}

}  // namespace graspd

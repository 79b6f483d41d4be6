// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/box_query.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace graspd {
namespace {

constexpr int kBeyond = std::numeric_limits<int>::max();  // layer of the row after the last

}  // namespace

void LocalPoints::show(std::size_t n) {
  a = {a_.data(), n};
  f = {f_.data(), n};
  z = {z_.data(), n};
  index = {index_.data(), n};
}

void LocalPoints::add_inside(const BoxTest& box, const PointRange& points) {
  const std::size_t n = size();
  if (const std::size_t most = n + points.size + kPointPadding; a_.size() < most) {
    const std::size_t room = std::max(most, 2 * a_.size());
    a_.resize(room);
    f_.resize(room);
    z_.resize(room);
    index_.resize(room);
  }
  show(n + point_kernels().keep_inside(box, points,
                                       {a_.data() + n, f_.data() + n, z_.data() + n, index_.data() + n}));
}

BoxTest box_test(const Eigen::Vector3f& origin, const Eigen::Matrix3f& rotation, const Eigen::Vector3f& min,
                 const Eigen::Vector3f& max) {
  const Eigen::Vector3f shift = -(rotation.transpose() * origin);
  BoxTest test;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) test.to_local[i][j] = rotation(j, i);
    test.shift[i] = shift[i];
    test.min[i] = min[i];
    test.max[i] = max[i];
  }
  return test;
}

/// The box, and which cells it meets.
struct BoxQuery::Box {
  /// One pair of faces, as rows along x meet them.
  struct Slab {
    float per_x;  // 0: the faces are parallel to x
    float min, max;
  };

  Eigen::Vector3f center, reach;  // of the box that is parallel to the axes and holds this one
  BoxTest test;
  Slab slabs[3];

  /// r: half thickness of the rows that are asked for.
  Box(const Eigen::Vector3f& origin, const Eigen::Matrix3f& rotation, const Eigen::Vector3f& min,
      const Eigen::Vector3f& max, float r)
      : center(origin + rotation * (0.5f * (min + max))),
        reach(rotation.cwiseAbs() * (0.5f * (max - min))),
        test(box_test(origin, rotation, min, max)) {
    for (int i = 0; i < 3; ++i) {
      const float x = rotation(0, i),
                  slack = r * (std::abs(rotation(1, i)) + std::abs(rotation(2, i))) + 1e-5f;
      slabs[i] = {std::abs(x) < 1e-4f ? 0 : 1 / x, min[i] - slack - test.shift[i],
                  max[i] + slack - test.shift[i]};
    }
  }

  /// The x that the row around the line (y, z) can have inside the box; empty when the first is larger.
  [[nodiscard]] std::pair<float, float> x_of_row(float y, float z) const {
    float lo = center.x() - reach.x(), hi = center.x() + reach.x();
    for (int i = 0; i < 3; ++i) {
      const float base = test.to_local[i][1] * y + test.to_local[i][2] * z;
      const float from = slabs[i].min - base, to = slabs[i].max - base, per_x = slabs[i].per_x;
      if (per_x == 0) {
        if (from > 1e-4f * std::abs(lo) + 1e-3f || to < -1e-4f * std::abs(lo) - 1e-3f) hi = lo - 1;
        continue;
      }
      lo = std::max(lo, (per_x > 0 ? from : to) * per_x);
      hi = std::min(hi, (per_x > 0 ? to : from) * per_x);
    }
    return {lo, hi};
  }
};

BoxQuery::BoxQuery(const PointCloud& cloud, float cell_m)
    : order_(order_by_cell(cloud, cell_m)), points_(cloud, order_.points) {
  std::int64_t end_of_row = std::numeric_limits<std::int64_t>::min();
  for (std::size_t c = 0; c < order_.num_cells(); ++c) {
    const std::int64_t key = order_.keys[c];
    if (key < end_of_row) continue;
    const std::int64_t z = key / order_.layer, y = key % order_.layer / order_.row;
    rows_.push_back(
        {static_cast<int>(z) + order_.min_cell.z(), static_cast<int>(y) + order_.min_cell.y(), c});
    end_of_row = z * order_.layer + (y + 1) * order_.row;
  }
  rows_.push_back({kBeyond, 0, order_.num_cells()});
}

PointRange BoxQuery::points_of_row(const Box& box, std::size_t r) const {
  const Row& row = rows_[r];
  const float cell = order_.cell_m;
  const auto [x0, x1] =
      box.x_of_row((static_cast<float>(row.y) + 0.5f) * cell, (static_cast<float>(row.z) + 0.5f) * cell);
  if (x0 > x1) return {};
  const int last_x = order_.min_cell.x() + static_cast<int>(order_.row) - 1;
  const int from_x = std::max(order_.min_cell.x(), cell_index(x0, 1 / cell));
  const int to_x = std::min(last_x, cell_index(x1, 1 / cell));
  if (from_x > to_x) return {};
  const auto key = [this](std::size_t c) { return order_.keys.begin() + static_cast<std::ptrdiff_t>(c); };
  const auto end_of_row = key(rows_[r + 1].first_cell);
  const auto begin = std::lower_bound(key(row.first_cell), end_of_row, order_.key({from_x, row.y, row.z}));
  const std::int64_t last = order_.key({to_x, row.y, row.z});
  auto end = begin;
  while (end != end_of_row && *end <= last) ++end;
  return points_.range(order_.starts[static_cast<std::size_t>(begin - order_.keys.begin())],
                       order_.starts[static_cast<std::size_t>(end - order_.keys.begin())]);
}

template <class Visit>
void BoxQuery::for_each_range(const Box& box, Visit visit) const {
  if (rows_.empty()) return;
  const float cell = order_.cell_m;
  const Eigen::Vector3f from = (box.center - box.reach) / cell, to = (box.center + box.reach) / cell;
  const Eigen::Vector3i lo = from.array().floor().cast<int>(), hi = to.array().floor().cast<int>();
  const auto first_from = [this](auto row, int z, int y) {
    return std::lower_bound(row, rows_.end(), Row{z, y, 0},
                            [](const Row& a, const Row& b) { return a.z != b.z ? a.z < b.z : a.y < b.y; });
  };
  auto row = first_from(rows_.begin(), lo.z(), lo.y());
  while (row->z <= hi.z()) {
    if (row->y < lo.y() || row->y > hi.y()) {
      row = first_from(row, row->y > hi.y() ? row->z + 1 : row->z, lo.y());
      continue;
    }
    const PointRange points = points_of_row(box, static_cast<std::size_t>(row - rows_.begin()));
    if (points.size > 0 && !visit(points)) return;
    ++row;
  }
}

void BoxQuery::find(const Eigen::Vector3f& origin, const Eigen::Matrix3f& rotation,
                    const Eigen::Vector3f& min, const Eigen::Vector3f& max, LocalPoints& out) const {
  const Box box(origin, rotation, min, max, 0.5f * order_.cell_m);
  out.clear();
  for_each_range(box, [&](const PointRange& points) {
    out.add_inside(box.test, points);
    return true;
  });
}

bool BoxQuery::has_more(const Eigen::Vector3f& origin, const Eigen::Matrix3f& rotation,
                        const Eigen::Vector3f& min, const Eigen::Vector3f& max, int limit) const {
  const Box box(origin, rotation, min, max, 0.5f * order_.cell_m);
  const PointKernels& kernels = point_kernels();
  const auto most = static_cast<std::size_t>(limit);
  std::size_t n = 0;
  for_each_range(box, [&](const PointRange& points) {
    n += kernels.count_inside(box.test, points);
    return n <= most;
  });
  return n > most;
}

}  // namespace graspd

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
  /// One value for each of the box's three pairs of faces, as rows along x meet them, and for the pair across
  /// x of the box that is parallel to the axes and holds this one.
  using Faces = Eigen::Array4f;

  Eigen::Vector3f center, reach;  // of the parallel box
  BoxTest test;
  Faces per_y, per_z;  // how far the faces move along their normal from row to row
  Faces min, max;      // where they are
  Faces per_distance;  // x for each metre along the normal

  /// r: half thickness of the rows that are asked for.
  Box(const Eigen::Vector3f& origin, const Eigen::Matrix3f& rotation, const Eigen::Vector3f& min_m,
      const Eigen::Vector3f& max_m, float r)
      : center(origin + rotation * (0.5f * (min_m + max_m))),
        reach(rotation.cwiseAbs() * (0.5f * (max_m - min_m))),
        test(box_test(origin, rotation, min_m, max_m)),
        per_y(rotation(1, 0), rotation(1, 1), rotation(1, 2), 0),
        per_z(rotation(2, 0), rotation(2, 1), rotation(2, 2), 0) {
    constexpr float kNowhere = 1e9f;
    for (int i = 0; i < 3; ++i) {
      const float x = rotation(0, i),
                  slack = r * (std::abs(rotation(1, i)) + std::abs(rotation(2, i))) + 1e-5f;
      const bool is_parallel = std::abs(x) < 1e-4f;  // to x: the pair does not bound it
      min[i] = is_parallel ? -kNowhere : min_m[i] - slack - test.shift[i];
      max[i] = is_parallel ? kNowhere : max_m[i] + slack - test.shift[i];
      per_distance[i] = is_parallel ? 1 : 1 / x;
    }
    min[3] = center.x() - reach.x();
    max[3] = center.x() + reach.x();
    per_distance[3] = 1;
  }

  /// The x that the row around the line (y, z) can have inside the box; empty when the first is larger.
  [[nodiscard]] std::pair<float, float> x_of_row(float y, float z) const {
    const Faces base = per_y * y + per_z * z;
    const Faces from = (min - base) * per_distance, to = (max - base) * per_distance;
    return {from.min(to).maxCoeff(), from.max(to).minCoeff()};
  }
};

BoxQuery::BoxQuery(const PointCloud& cloud, float cell_m) : cell_m_(cell_m) {
  constexpr int kMostGap = 16;  // cells without points within a row: bounds the table, whatever the cloud
  const CellOrder order = order_by_cell(cloud, cell_m);
  points_ = PaddedPoints(cloud, order.points);
  const std::size_t num_cells = order.num_cells();
  std::int64_t last_key = std::numeric_limits<std::int64_t>::min() / 2;
  for (std::size_t c = 0; c < num_cells; ++c) {
    const std::int64_t key = order.keys[c];
    const Eigen::Vector3i cell = order.cell_of(key);
    const bool goes_on =
        key - last_key <= kMostGap && cell.y() == rows_.back().y && cell.z() == rows_.back().z;
    if (!goes_on) {
      if (!rows_.empty()) row_starts_.push_back(order.starts[c]);
      rows_.push_back({cell.z(), cell.y(), cell.x(), 0, row_starts_.size()});
    }
    Row& row = rows_.back();
    for (; row.num_cells <= cell.x() - row.x; ++row.num_cells) row_starts_.push_back(order.starts[c]);
    last_key = key;
  }
  row_starts_.push_back(order.starts[num_cells]);
  rows_.push_back({kBeyond, 0, 0, 0, 0});
}

PointRange BoxQuery::points_of_row(const Box& box, const Row& row) const {
  const auto [x0, x1] = box.x_of_row((static_cast<float>(row.y) + 0.5f) * cell_m_,
                                     (static_cast<float>(row.z) + 0.5f) * cell_m_);
  if (x0 > x1) return {};
  const int from = std::max(0, cell_index(x0, 1 / cell_m_) - row.x);
  const int to = std::min(row.num_cells, cell_index(x1, 1 / cell_m_) + 1 - row.x);
  if (from >= to) return {};
  const std::uint32_t* starts = row_starts_.data() + row.start;
  return points_.range(starts[from], starts[to]);
}

template <class Visit>
void BoxQuery::for_each_range(const Box& box, Visit visit) const {
  if (rows_.empty()) return;
  const Eigen::Vector3f from = (box.center - box.reach) / cell_m_, to = (box.center + box.reach) / cell_m_;
  const Eigen::Vector3i lo = from.array().floor().cast<int>(), hi = to.array().floor().cast<int>();
  const auto first_from = [this](auto row, int z, int y) {
    return std::lower_bound(row, rows_.end(), Row{z, y, 0, 0, 0},
                            [](const Row& a, const Row& b) { return a.z != b.z ? a.z < b.z : a.y < b.y; });
  };
  auto row = first_from(rows_.begin(), lo.z(), lo.y());
  while (row->z <= hi.z()) {
    if (row->y < lo.y() || row->y > hi.y()) {
      row = first_from(row, row->y > hi.y() ? row->z + 1 : row->z, lo.y());
      continue;
    }
    const PointRange points = points_of_row(box, *row);
    if (points.size > 0 && !visit(points)) return;
    ++row;
  }
}

void BoxQuery::find(const Eigen::Vector3f& origin, const Eigen::Matrix3f& rotation,
                    const Eigen::Vector3f& min, const Eigen::Vector3f& max, LocalPoints& out) const {
  const Box box(origin, rotation, min, max, 0.5f * cell_m_);
  out.clear();
  for_each_range(box, [&](const PointRange& points) {
    out.add_inside(box.test, points);
    return true;
  });
}

bool BoxQuery::has_more(const Eigen::Vector3f& origin, const Eigen::Matrix3f& rotation,
                        const Eigen::Vector3f& min, const Eigen::Vector3f& max, int limit) const {
  const Box box(origin, rotation, min, max, 0.5f * cell_m_);
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

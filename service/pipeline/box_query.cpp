// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/box_query.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace graspd {
namespace {

constexpr std::size_t kRows = 64;    // looked at together
constexpr std::size_t kSpans = 128;  // the same

}  // namespace

void LocalPoints::show(std::size_t n) {
  a = {a_.data(), n};
  f = {f_.data(), n};
  z = {z_.data(), n};
  index = {index_.data(), n};
}

void LocalPoints::add_inside(const BoxTest& box, const PointRange& points, std::span<const PointSpan> spans) {
  const std::size_t n = size();
  std::size_t most = n + kPointPadding;
  for (const PointSpan& span : spans) most += span.end - span.begin;
  if (a_.size() < most) {
    const std::size_t room = std::max(most, 2 * a_.size());
    a_.resize(room);
    f_.resize(room);
    z_.resize(room);
    index_.resize(room);
  }
  show(n + point_kernels().keep_inside(box, points, spans,
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

  /// What the faces leave of the rows in the layer around z.
  [[nodiscard]] RowLimits limits(float z, float cell_m) const {
    const Faces base = per_z * z, slope = per_y * per_distance;
    const Faces from = (min - base) * per_distance, to = (max - base) * per_distance;
    RowLimits limits;
    Eigen::Map<Faces>(limits.least) = from.min(to);
    Eigen::Map<Faces>(limits.most) = from.max(to);
    Eigen::Map<Faces>(limits.slope) = slope;
    limits.cell_m = cell_m;
    return limits;
  }
};

BoxQuery::BoxQuery(const PointCloud& cloud, const CellOrder& order)
    : cell_m_(order.cell_m), points_(cloud, order.points) {
  constexpr int kMostGap = 16;  // cells without points within a row: bounds the table, whatever the cloud
  const std::size_t num_cells = order.num_cells();
  std::int64_t last_key = std::numeric_limits<std::int64_t>::min() / 2;
  for (std::size_t c = 0; c < num_cells; ++c) {
    const std::int64_t key = order.keys[c];
    const std::uint32_t position = order.starts[c];
    const Eigen::Vector3i cell = order.cell_of(key);
    const bool same_layer = !layers_.empty() && cell.z() == layers_.back().z;
    const bool goes_on = same_layer && cell.y() == row_y_.back() && key - last_key <= kMostGap;
    if (!goes_on) {
      if (!row_y_.empty()) cell_starts_.push_back(position);
      if (!same_layer) layers_.push_back({cell.z(), row_y_.size()});
      row_y_.push_back(cell.y());
      row_x_.push_back(cell.x());
      row_cells_.push_back(0);
      row_start_.push_back(static_cast<std::uint32_t>(cell_starts_.size()));
    }
    for (std::int32_t& n = row_cells_.back(); n <= cell.x() - row_x_.back(); ++n)
      cell_starts_.push_back(position);
    last_key = key;
  }
  cell_starts_.push_back(order.starts.back());
  layers_.push_back({std::numeric_limits<int>::max(), row_y_.size()});
  for (std::pmr::vector<std::int32_t>* v : {&row_y_, &row_x_, &row_cells_})
    v->resize(v->size() + kPointPadding);
}

template <class Visit>
void BoxQuery::for_each_part(const Box& box, Visit visit) const {
  if (layers_.empty()) return;
  const Eigen::Vector3f from_m = (box.center - box.reach) / cell_m_,
                        to_m = (box.center + box.reach) / cell_m_;
  const Eigen::Vector3i lo = from_m.array().floor().cast<int>(), hi = to_m.array().floor().cast<int>();
  std::array<std::int32_t, kRows + kPointPadding> from, to;
  std::array<PointSpan, kSpans> spans;
  std::size_t n = 0;
  auto layer = std::lower_bound(layers_.begin(), layers_.end() - 1, lo.z(),
                                [](const Layer& l, int z) { return l.z < z; });
  for (; layer->z <= hi.z(); ++layer) {
    const RowLimits limits = box.limits((static_cast<float>(layer->z) + 0.5f) * cell_m_, cell_m_);
    const auto y = row_y_.begin(), begin = y + static_cast<std::ptrdiff_t>(layer->row),
               end = y + static_cast<std::ptrdiff_t>((layer + 1)->row);
    auto row = static_cast<std::size_t>(std::lower_bound(begin, end, lo.y()) - y);
    const auto last = static_cast<std::size_t>(std::upper_bound(begin, end, hi.y()) - y);
    for (; row < last; row += kRows) {
      const std::size_t size = std::min(kRows, last - row);
      point_kernels().meet_rows(limits, {&row_y_[row], &row_x_[row], &row_cells_[row], size}, from.data(),
                                to.data());
      for (std::size_t i = 0; i < size; ++i) {
        if (from[i] >= to[i]) continue;
        const std::uint32_t* starts = cell_starts_.data() + row_start_[row + i];
        const PointSpan span{starts[from[i]], starts[to[i]]};
        if (span.begin == span.end) continue;
        spans[n++] = span;
        if (n == kSpans && !visit(std::span<const PointSpan>(spans.data(), std::exchange(n, 0)))) return;
      }
    }
  }
  if (n > 0) visit(std::span<const PointSpan>(spans.data(), n));
}

void BoxQuery::find(const Eigen::Vector3f& origin, const Eigen::Matrix3f& rotation,
                    const Eigen::Vector3f& min, const Eigen::Vector3f& max, LocalPoints& out) const {
  const Box box(origin, rotation, min, max, 0.5f * cell_m_);
  out.clear();
  for_each_part(box, [&](std::span<const PointSpan> spans) {
    out.add_inside(box.test, points_.all(), spans);
    return true;
  });
}

bool BoxQuery::has_more(const Eigen::Vector3f& origin, const Eigen::Matrix3f& rotation,
                        const Eigen::Vector3f& min, const Eigen::Vector3f& max, int limit) const {
  const Box box(origin, rotation, min, max, 0.5f * cell_m_);
  const PointKernels& kernels = point_kernels();
  const auto most = static_cast<std::size_t>(limit);
  std::size_t n = 0;
  for_each_part(box, [&](std::span<const PointSpan> spans) {
    n += kernels.count_inside(box.test, points_.all(), spans, most - n);
    return n <= most;
  });
  return n > most;
}

}  // namespace graspd

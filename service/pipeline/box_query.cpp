// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/box_query.hpp"

#include <algorithm>
#include <cmath>

namespace graspd {

namespace {

struct Block {
  static constexpr std::size_t kSize = 32;
  float a[kSize], f[kSize], z[kSize];
  int inside[kSize];
};

}  // namespace

/// The box, and what takes points to its coordinates.
struct BoxQuery::Box {
  Eigen::Vector3f origin, min, max;
  Eigen::Matrix3f to_local;
  Eigen::Vector3f shift;  // local = to_local * p + shift

  Box(const Eigen::Vector3f& o, const Eigen::Matrix3f& rotation, const Eigen::Vector3f& lo,
      const Eigen::Vector3f& hi)
      : origin(o), min(lo), max(hi), to_local(rotation.transpose()), shift(-(rotation.transpose() * o)) {}

  /// Coordinates of n points in the box's frame, and 1 for each inside. Plain scalars and arrays, so that the
  /// compiler can use vectors.
  void transform(const float* x, const float* y, const float* z, std::size_t n, Block& out) const {
    float *a = out.a, *f = out.f, *depth = out.z;
    int* inside = out.inside;
    const float r00 = to_local(0, 0), r01 = to_local(0, 1), r02 = to_local(0, 2), t0 = shift[0];
    const float r10 = to_local(1, 0), r11 = to_local(1, 1), r12 = to_local(1, 2), t1 = shift[1];
    const float r20 = to_local(2, 0), r21 = to_local(2, 1), r22 = to_local(2, 2), t2 = shift[2];
    const float a0 = min[0], a1 = max[0], f0 = min[1], f1 = max[1], z0 = min[2], z1 = max[2];
    for (std::size_t k = 0; k < n; ++k) {
      a[k] = r00 * x[k] + r01 * y[k] + r02 * z[k] + t0;
      f[k] = r10 * x[k] + r11 * y[k] + r12 * z[k] + t1;
      depth[k] = r20 * x[k] + r21 * y[k] + r22 * z[k] + t2;
      inside[k] = int{a[k] >= a0} & int{a[k] <= a1} & int{f[k] >= f0} & int{f[k] <= f1} &
                  int{depth[k] >= z0} & int{depth[k] <= z1};
    }
  }

  /// Narrows [lo, hi] to the x that a row of half thickness r around the line (y, z) can have inside the box.
  void clip_row(float y, float z, float r, float& lo, float& hi) const {
    for (int i = 0; i < 3; ++i) {
      const float slope = to_local(i, 0), base = to_local(i, 1) * y + to_local(i, 2) * z + shift[i];
      const float slack = r * (std::abs(to_local(i, 1)) + std::abs(to_local(i, 2))) + 1e-5f;
      const float from = min[i] - slack - base, to = max[i] + slack - base;
      if (std::abs(slope) < 1e-4f) {
        if (from > 1e-4f * std::abs(lo) + 1e-3f || to < -1e-4f * std::abs(lo) - 1e-3f) hi = lo - 1;
        continue;
      }
      lo = std::max(lo, slope > 0 ? from / slope : to / slope);
      hi = std::min(hi, slope > 0 ? to / slope : from / slope);
    }
  }
};

BoxQuery::BoxQuery(const PointCloud& cloud, float cell_m) : order_(order_by_cell(cloud, cell_m)) {
  const std::size_t n = cloud.size();
  x_.resize(n);
  y_.resize(n);
  z_.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    const std::uint32_t i = order_.points[k];
    x_[k] = cloud.x[i];
    y_[k] = cloud.y[i];
    z_[k] = cloud.z[i];
  }
}

template <class Visit>
void BoxQuery::for_each_range(const Box& box, Visit visit) const {
  const float cell = order_.cell_m;
  const Eigen::Vector3f center = box.origin + box.to_local.transpose() * (0.5f * (box.min + box.max));
  const Eigen::Vector3f reach = box.to_local.transpose().cwiseAbs() * (0.5f * (box.max - box.min));
  const Eigen::Vector3i lo = ((center - reach) / cell).array().floor().cast<int>();
  const Eigen::Vector3i hi = ((center + reach) / cell).array().floor().cast<int>();
  const Eigen::Vector3i first = lo.cwiseMax(order_.min_cell);
  const int last_y =
      std::min<int>(hi.y(), order_.min_cell.y() + static_cast<int>(order_.layer / order_.row) - 1);
  const int last_x = std::min<int>(hi.x(), order_.min_cell.x() + static_cast<int>(order_.row) - 1);
  for (int cz = first.z(); cz <= hi.z(); ++cz)
    for (int cy = first.y(); cy <= last_y; ++cy) {
      float x0 = center.x() - reach.x(), x1 = center.x() + reach.x();
      box.clip_row((static_cast<float>(cy) + 0.5f) * cell, (static_cast<float>(cz) + 0.5f) * cell,
                   0.5f * cell, x0, x1);
      if (x0 > x1) continue;
      const int from_x = std::max(first.x(), static_cast<int>(std::floor(x0 / cell)));
      const int to_x = std::min(last_x, static_cast<int>(std::floor(x1 / cell)));
      if (from_x > to_x) continue;
      const auto begin =
          std::lower_bound(order_.keys.begin(), order_.keys.end(), order_.key({from_x, cy, cz}));
      const std::int64_t last = order_.key({to_x, cy, cz});
      auto end = begin;
      while (end != order_.keys.end() && *end <= last) ++end;
      if (begin == end) continue;
      if (!visit(order_.starts[static_cast<std::size_t>(begin - order_.keys.begin())],
                 order_.starts[static_cast<std::size_t>(end - order_.keys.begin())]))
        return;
    }
}

void BoxQuery::find(const Eigen::Vector3f& origin, const Eigen::Matrix3f& rotation,
                    const Eigen::Vector3f& min, const Eigen::Vector3f& max, LocalPoints& out) const {
  const Box box(origin, rotation, min, max);
  Block block;
  std::size_t n = 0;
  for_each_range(box, [&](std::size_t from, std::size_t to) {
    if (out.a.size() < n + (to - from)) out.resize(std::max(2 * out.a.size(), n + (to - from)));
    for (; from < to; from += Block::kSize) {
      const std::size_t size = std::min(Block::kSize, to - from);
      box.transform(x_.data() + from, y_.data() + from, z_.data() + from, size, block);
      for (std::size_t k = 0; k < size; ++k) {
        out.a[n] = block.a[k];
        out.f[n] = block.f[k];
        out.z[n] = block.z[k];
        out.index[n] = order_.points[from + k];
        n += static_cast<std::size_t>(block.inside[k]);
      }
    }
    return true;
  });
  out.resize(n);
}

bool BoxQuery::has_more(const Eigen::Vector3f& origin, const Eigen::Matrix3f& rotation,
                        const Eigen::Vector3f& min, const Eigen::Vector3f& max, int limit) const {
  const Box box(origin, rotation, min, max);
  Block block;
  int n = 0;
  for_each_range(box, [&](std::size_t from, std::size_t to) {
    for (; from < to; from += Block::kSize) {
      const std::size_t size = std::min(Block::kSize, to - from);
      box.transform(x_.data() + from, y_.data() + from, z_.data() + from, size, block);
      for (std::size_t k = 0; k < size; ++k) n += block.inside[k];
    }
    return n <= limit;
  });
  return n > limit;
}

}  // namespace graspd

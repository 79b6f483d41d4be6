// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/box_query.hpp"

#include <algorithm>
#include <cmath>

namespace graspd {

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

void BoxQuery::find(const Eigen::Vector3f& origin, const Eigen::Matrix3f& rotation, const Eigen::Vector3f& min,
                    const Eigen::Vector3f& max, LocalPoints& out) const {
  const Eigen::Vector3f center = origin + rotation * (0.5f * (min + max));
  const Eigen::Vector3f reach = rotation.cwiseAbs() * (0.5f * (max - min));
  const Eigen::Vector3i lo = ((center - reach) / order_.cell_m).array().floor().cast<int>();
  const Eigen::Vector3i hi = ((center + reach) / order_.cell_m).array().floor().cast<int>();
  const Eigen::Matrix3f to_local = rotation.transpose();
  const Eigen::Vector3f t = -(to_local * origin);

  std::size_t n = 0;
  const auto grow = [&](std::size_t more) {
    if (out.a.size() >= n + more) return;
    const std::size_t size = std::max(2 * out.a.size(), n + more);
    out.a.resize(size);
    out.f.resize(size);
    out.z.resize(size);
    out.index.resize(size);
  };
  for (int cz = lo.z(); cz <= hi.z(); ++cz)
    for (int cy = lo.y(); cy <= hi.y(); ++cy) {
      const std::int64_t first = order_.key({lo.x(), cy, cz}), last = order_.key({hi.x(), cy, cz});
      const bool in_grid = cy > order_.min_cell.y() && cz > order_.min_cell.z() &&
                           cy - order_.min_cell.y() < order_.layer / order_.row;
      if (!in_grid) continue;
      // A box that reaches beyond the row must not find the cells of the rows before and after.
      const std::int64_t row_begin = order_.key({order_.min_cell.x(), cy, cz});
      const auto begin = std::lower_bound(order_.keys.begin(), order_.keys.end(), std::max(first, row_begin));
      const auto end = std::upper_bound(begin, order_.keys.end(), std::min(last, row_begin + order_.row - 1));
      if (begin >= end) continue;
      const std::size_t from = order_.starts[static_cast<std::size_t>(begin - order_.keys.begin())];
      const std::size_t to = order_.starts[static_cast<std::size_t>(end - order_.keys.begin())];
      grow(to - from);
      for (std::size_t k = from; k < to; ++k) {
        const float a = to_local(0, 0) * x_[k] + to_local(0, 1) * y_[k] + to_local(0, 2) * z_[k] + t.x();
        const float f = to_local(1, 0) * x_[k] + to_local(1, 1) * y_[k] + to_local(1, 2) * z_[k] + t.y();
        const float z = to_local(2, 0) * x_[k] + to_local(2, 1) * y_[k] + to_local(2, 2) * z_[k] + t.z();
        out.a[n] = a;
        out.f[n] = f;
        out.z[n] = z;
        out.index[n] = order_.points[k];
        const bool inside = (a >= min.x()) & (a <= max.x()) & (f >= min.y()) & (f <= max.y()) & (z >= min.z()) &
                            (z <= max.z());
        n += inside ? 1 : 0;
      }
    }
  out.a.resize(n);
  out.f.resize(n);
  out.z.resize(n);
  out.index.resize(n);
}

}  // namespace graspd

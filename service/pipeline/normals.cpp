// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/normals.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "service/pipeline/point_kernels.hpp"

namespace graspd {
namespace {

/// Normals of points whose neighbourhoods are solved side by side.
class NormalBatch {
 public:
  NormalBatch(const PointCloud& cloud, const Neighborhoods& neighborhoods, Normals& normals)
      : cloud_(cloud), neighborhoods_(neighborhoods), kernels_(point_kernels()), normals_(normals) {}

  void add(std::size_t point) {
    lists_[size_] = neighborhoods_.list(point);
    towards_.x[size_] = cloud_.viewpoint.x() - cloud_.x[point];
    towards_.y[size_] = cloud_.viewpoint.y() - cloud_.y[point];
    towards_.z[size_] = cloud_.viewpoint.z() - cloud_.z[point];
    if (++size_ == kSolved) solve();
  }

  /// Those that are left.
  void solve() {
    if (size_ == 0) return;
    MomentLanes moments;
    NormalLanes n;
    kernels_.sum_moments(cloud_.x.data(), cloud_.y.data(), cloud_.z.data(), {lists_, size_}, moments);
    kernels_.solve_planes(moments, n);
    for (std::size_t k = 0; k < kSolved; ++k) {
      const float cosine = n.x[k] * towards_.x[k] + n.y[k] * towards_.y[k] + n.z[k] * towards_.z[k];
      const float sign = cosine < 0 ? -1.0f : 1.0f;
      n.x[k] *= sign;
      n.y[k] *= sign;
      n.z[k] *= sign;
    }
    for (std::size_t k = 0; k < size_; ++k) {
      const std::size_t i = lists_[k].point;
      normals_.x[i] = n.x[k];
      normals_.y[i] = n.y[k];
      normals_.z[i] = n.z[k];
    }
    size_ = 0;
  }

 private:
  const PointCloud& cloud_;
  const Neighborhoods& neighborhoods_;
  const PointKernels& kernels_;
  Normals& normals_;
  NeighborList lists_[kSolved] = {};
  NormalLanes towards_{};  // from the points to the sensor
  std::size_t size_ = 0;
};

}  // namespace

Normals estimate_normals(const PointCloud& cloud, const Neighborhoods& neighborhoods,
                         const Eigen::Vector3f& others) {
  Normals normals(cloud.size(), others);
  estimate_normals(cloud, neighborhoods, normals);
  return normals;
}

void estimate_normals(const PointCloud& cloud, const Neighborhoods& neighborhoods, Normals& normals) {
  const std::span<const std::uint32_t> points = neighborhoods.points();
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 512), [&](const auto& range) {
    NormalBatch batch(cloud, neighborhoods, normals);
    for (std::size_t k = range.begin(); k != range.end(); ++k)
      if (neighborhoods.of(points[k]).size() >= 3)
        batch.add(points[k]);
      else
        normals.x[points[k]] = normals.y[points[k]] = normals.z[points[k]] = 0;
    batch.solve();
  });
}

}  // namespace graspd

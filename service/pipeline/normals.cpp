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
    const std::span<const std::uint32_t> neighborhood = neighborhoods_.of(point);
    const Moments m =
        kernels_.sum_moments({cloud_.x[point], cloud_.y[point], cloud_.z[point]}, cloud_.x.data(),
                             cloud_.y.data(), cloud_.z.data(), neighborhood.data(), neighborhood.size());
    const std::size_t k = size_++;
    moments_.x[k] = m.x;
    moments_.y[k] = m.y;
    moments_.z[k] = m.z;
    moments_.xx[k] = m.xx;
    moments_.xy[k] = m.xy;
    moments_.xz[k] = m.xz;
    moments_.yy[k] = m.yy;
    moments_.yz[k] = m.yz;
    moments_.zz[k] = m.zz;
    moments_.count[k] = static_cast<float>(neighborhood.size());
    points_[k] = point;
    if (size_ == kSolved) solve();
  }

  /// Those that are left.
  void solve() {
    NormalLanes n;
    kernels_.solve_planes(moments_, n);
    for (std::size_t k = 0; k < size_; ++k) {
      const std::size_t i = points_[k];
      const Eigen::Vector3f to_sensor = cloud_.viewpoint - cloud_.point(i);
      const float sign =
          n.x[k] * to_sensor.x() + n.y[k] * to_sensor.y() + n.z[k] * to_sensor.z() < 0 ? -1.0f : 1.0f;
      normals_.x[i] = sign * n.x[k];
      normals_.y[i] = sign * n.y[k];
      normals_.z[i] = sign * n.z[k];
    }
    size_ = 0;
  }

 private:
  const PointCloud& cloud_;
  const Neighborhoods& neighborhoods_;
  const PointKernels& kernels_;
  Normals& normals_;
  MomentLanes moments_{};
  std::size_t points_[kSolved] = {};
  std::size_t size_ = 0;
};

}  // namespace

Normals estimate_normals(const PointCloud& cloud, const Neighborhoods& neighborhoods) {
  Normals normals(cloud.size());
  estimate_normals(cloud, neighborhoods, normals);
  return normals;
}

void estimate_normals(const PointCloud& cloud, const Neighborhoods& neighborhoods, Normals& normals) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cloud.size(), 1024), [&](const auto& range) {
    NormalBatch batch(cloud, neighborhoods, normals);
    for (std::size_t i = range.begin(); i != range.end(); ++i)
      if (neighborhoods.of(i).size() >= 3) batch.add(i);
    batch.solve();
  });
}

}  // namespace graspd

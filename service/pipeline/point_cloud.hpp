// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// One frame of a depth sensor as points, in the layout the pipeline works on.
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "service/pipeline/raw_vector.hpp"

namespace graspd {

/// Points as a structure of arrays [m], in the cloud's frame. Missing points are NaN. Holds coordinates
/// alone: colours and labels never reach the pipeline. What resize() adds has no value yet.
struct PointCloud {
  RawVector<float> x, y, z;
  /// Organized clouds: size() == width * height, row by row. Unorganized: height is 1.
  int width = 0;
  int height = 1;
  /// Origin of the sensor in the cloud's frame [m].
  Eigen::Vector3f viewpoint = Eigen::Vector3f::Zero();

  [[nodiscard]] std::size_t size() const { return x.size(); }
  [[nodiscard]] bool empty() const { return x.empty(); }
  [[nodiscard]] Eigen::Vector3f point(std::size_t i) const { return {x[i], y[i], z[i]}; }
  void resize(std::size_t n) {
    x.resize(n);
    y.resize(n);
    z.resize(n);
  }
  void push_back(const Eigen::Vector3f& p) {
    x.push_back(p.x());
    y.push_back(p.y());
    z.push_back(p.z());
  }
};

/// Of so many points, which have no value yet.
[[nodiscard]] inline PointCloud unorganized_cloud(std::size_t size, const Eigen::Vector3f& viewpoint) {
  PointCloud cloud;
  cloud.resize(size);
  cloud.width = static_cast<int>(size);
  cloud.viewpoint = viewpoint;
  return cloud;
}

}  // namespace graspd

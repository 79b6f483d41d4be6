// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Which points of an object are near a place, asked for at many places.
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "service/pipeline/cell_order.hpp"
#include "service/pipeline/point_cloud.hpp"
#include "service/pipeline/point_kernels.hpp"
#include "service/pipeline/raw_vector.hpp"

namespace graspd {

class NearPoints {
 public:
  /// Working memory of one thread.
  struct Buffer {
    RawVector<std::int32_t> is_near;  // each block
    std::pmr::vector<PointSpan> spans;
    RawVector<std::uint32_t> near;
  };

  /// points: indices into the cloud, in an order in which those that follow one another are near each other.
  NearPoints(const PointCloud& cloud, std::span<const std::uint32_t> points);

  /// Indices into the cloud of the points within a distance of p [m], in their order; until the next call
  /// with the buffer.
  [[nodiscard]] std::span<const std::uint32_t> within(const Eigen::Vector3f& p, float distance_m,
                                                      Buffer& buffer) const;

 private:
  /// Writes for each block whether a box with a half side around p may meet it.
  void test_blocks(const Eigen::Vector3f& p, float half_m, std::int32_t* is_near) const;

  /// Most blocks of a few points are nowhere near a place.
  static constexpr std::size_t kBlock = 64;

  PaddedPoints points_;
  std::array<RawVector<float>, 3> low_, high_;  // of each block, by axis
};

}  // namespace graspd

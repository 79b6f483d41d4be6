// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Faces of several things that stand flush, such as the backs of books in a row: one surface, but what it
// meets at its edge ends in steps.
#pragma once
#include <cstdint>
#include <memory_resource>
#include <span>
#include <utility>
#include <vector>

#include "service/pipeline/segments.hpp"

namespace graspd {

struct FlushFace {
  /// A thing that the face is a part of, by another of its segments, and where it is along the face [m].
  struct Part {
    std::int32_t segment;
    float low_m, high_m;
  };
  std::int32_t segment;
  Eigen::Vector3f along;         ///< unit vector in which the things follow one another
  std::pmr::vector<Part> parts;  ///< at least two, ascending

  /// The part that a point of the face is of.
  [[nodiscard]] const Part& part_at(const Eigen::Vector3f& p) const;
};

/// convex: pairs of segments that meet at a convex border. A face is flush when it meets two parallel ones
/// that lie beside each other and at different heights: nothing that is whole has a step there without a face
/// in it.
[[nodiscard]] std::pmr::vector<FlushFace> find_flush_faces(
    const PointCloud& cloud, const Segments& segments,
    std::span<const std::pair<std::int32_t, std::int32_t>> convex);

}  // namespace graspd

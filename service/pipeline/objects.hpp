// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Object hypotheses: segments that meet at a convex border are taken for one object.
#pragma once
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "service/pipeline/neighborhoods.hpp"
#include "service/pipeline/normals.hpp"
#include "service/pipeline/raw_vector.hpp"
#include "service/pipeline/segments.hpp"

namespace graspd {

struct ObjectsConfig {
  float min_convex_share = 0.6f;
  int min_border_pairs = 8;
  float min_whole_convex_share = 0.4f;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& v) {
    v("min_convex_share", self.min_convex_share, Range{0, 1},
      "segments are one object when this share of their border is convex");
    v("min_border_pairs", self.min_border_pairs, Range{1, 100000},
      "and their border has this many pairs of neighbours");
    v("min_whole_convex_share", self.min_whole_convex_share, Range{0, 1},
      "objects without a handle are tried together with neighbours when this share of the border is convex");
  }
};

struct Objects {
  int num_objects = 0;
  std::pmr::vector<std::int32_t> of_segment;  ///< object of each segment
  std::pmr::vector<std::int32_t> of_point;    ///< object of each point; negative: none
  std::pmr::vector<Eigen::Vector3f> center;   ///< mean of each object's points
  /// Points at which objects may meet, ascending: those in no segment, and those with neighbours of another
  /// segment or of none. group_segments() alone sets it.
  RawVector<std::uint32_t> at_borders;
};

/// Indices of the points of each object.
struct ObjectPoints {
  RawVector<std::uint32_t> points;         ///< of one object after the other, ascending for each
  std::pmr::vector<std::uint32_t> starts;  ///< where each object's begin; one more at the end

  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t object) const {
    return {points.data() + starts[object], points.data() + starts[object + 1]};
  }
};

[[nodiscard]] ObjectPoints points_by_object(const Objects& objects);

/// 1 for each object that has a segment with wanted[segment] != 0.
[[nodiscard]] std::pmr::vector<std::uint8_t> objects_with_segments(
    const Objects& objects, const std::pmr::vector<std::uint8_t>& wanted);

/// A pair of neighbours i, j of two segments is convex when (n_i - n_j) . (p_i - p_j) > 0. Parallel segments
/// with a step between them are two objects that touch. Points in no segment take the object of most of their
/// neighbours, except those of the support (is_support, may be empty).
[[nodiscard]] Objects group_segments(const PointCloud& cloud, const Normals& normals,
                                     const Neighborhoods& neighborhoods, const Segments& segments,
                                     const std::pmr::vector<std::uint8_t>& is_support,
                                     const ObjectsConfig& config);

/// A coarser guess for where the first one fails: objects that meet at a border which does not speak against
/// one object, such as the outside and the inside of a mug at its thin rim. The border counts all points of
/// an object, also those in no segment.
[[nodiscard]] Objects merge_objects(const PointCloud& cloud, const Normals& normals,
                                    const Neighborhoods& neighborhoods, const Objects& objects,
                                    const ObjectsConfig& config);

}  // namespace graspd

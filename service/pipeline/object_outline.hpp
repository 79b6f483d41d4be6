// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// A few points of each object, spread evenly: enough to see at little cost that a candidate is much too wide.
#pragma once
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "service/pipeline/gripper.hpp"
#include "service/pipeline/handle_check.hpp"
#include "service/pipeline/point_cloud.hpp"

namespace graspd {

class ObjectOutlines {
 public:
  ObjectOutlines(const PointCloud& cloud, const ObjectPoints& points);

  /// Whether the candidate's object goes on without a gap for clearly more than the aperture along the
  /// closing axis, within the band and depth that the fingers would take. False says nothing.
  /// buffer: working memory.
  [[nodiscard]] bool clearly_too_wide(const Candidate& candidate, const Gripper& gripper,
                                      LocalPoints& buffer) const;

 private:
  std::pmr::vector<PaddedPoints> objects_;
};

}  // namespace graspd

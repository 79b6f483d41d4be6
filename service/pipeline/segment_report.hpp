// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What became of one segment: why it has no handle.
#pragma once
#include <Eigen/Core>

#include "service/pipeline/handle_check.hpp"

namespace graspd {

struct SegmentReport {
  Eigen::Vector3f centroid = Eigen::Vector3f::Zero();  ///< [m]
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();   ///< n, towards the sensor
  Eigen::Vector3f major = Eigen::Vector3f::UnitX();    ///< a
  int num_points = 0;                                  ///< voxels
  int object = -1;
  int num_candidates = 0;    ///< on it, accepted or refused
  int num_handles = 0;       ///< of those that passed all checks; before one per place is kept
  FailureCounts failures{};  ///< of the others, by the first check they failed

  /// The last check that one of the candidates reached: kNone when there are handles.
  [[nodiscard]] Failure reason() const {
    if (num_handles > 0) return Failure::kNone;
    for (std::size_t i = kNumFailures; i-- > 0;)
      if (failures[i] > 0) return static_cast<Failure>(i);
    return Failure::kTooFewPoints;
  }
};

}  // namespace graspd

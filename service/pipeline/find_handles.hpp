// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Searches and checks in rounds: each candidate first against the voxels, which costs little, then against
// every point.
#pragma once
#include <vector>

#include "service/pipeline/detect_config.hpp"
#include "service/pipeline/segment_report.hpp"
#include "service/pipeline/surfaces.hpp"

namespace graspd {

struct CheckedCandidates {
  std::vector<RankedHandle> handles;  ///< in the order of the candidates within each round
  std::vector<SegmentReport> segments;
  int num_tried = 0;
  FailureCounts failures{};  ///< of all candidates tried
};

/// cloud: every point of the workspace, that the surfaces were found in.
[[nodiscard]] CheckedCandidates find_handles(const PointCloud& cloud, const Surfaces& surfaces,
                                             const Gripper& gripper, const DetectConfig& config);

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Checks all candidates: first against the voxels, which costs little, then what is left against every point.
#pragma once
#include <vector>

#include "service/pipeline/detect_config.hpp"
#include "service/pipeline/surfaces.hpp"

namespace graspd {

struct CheckedCandidates {
  int num_tried = 0;
  std::vector<RankedHandle> handles;   ///< in the order of the candidates
  FailureCounts candidate_failures{};  ///< by the first check that a candidate failed
  FailureCounts segment_failures{};    ///< segments without a handle, by the last check that one of its candidates reached
};

/// cloud: every point of the workspace, that the surfaces were found in.
[[nodiscard]] CheckedCandidates check_candidates(const PointCloud& cloud, const Surfaces& surfaces,
                                                 const std::vector<Candidate>& candidates, const Gripper& gripper,
                                                 const DetectConfig& config);

}  // namespace graspd

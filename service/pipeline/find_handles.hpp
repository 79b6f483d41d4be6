// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The second half of the method: from surfaces to handles.
#pragma once
#include <memory_resource>
#include <vector>

#include "service/pipeline/detect_config.hpp"
#include "service/pipeline/gripper.hpp"
#include "service/pipeline/guess_search.hpp"
#include "service/pipeline/segment_report.hpp"
#include "service/pipeline/surfaces.hpp"

namespace graspd {

struct FoundHandles {
  std::pmr::vector<Handle> handles;  ///< best first
  std::pmr::vector<SegmentReport> segments;
  int num_tried = 0;         ///< candidates
  FailureCounts failures{};  ///< of all candidates tried
};

/// cloud: every point of the workspace, that the surfaces were found in; depth_map: of the same.
[[nodiscard]] FoundHandles find_handles(const PointCloud& cloud, const DepthMap& depth_map,
                                        const Surfaces& surfaces, const Gripper& gripper,
                                        const DetectConfig& config);

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The whole method: a cloud in, handles out (paper, sections 4 and 5).
#pragma once
#include <array>
#include <functional>
#include <memory_resource>
#include <string_view>
#include <vector>

#include "service/pipeline/detect_config.hpp"
#include "service/pipeline/gripper.hpp"
#include "service/pipeline/handle.hpp"
#include "service/pipeline/handle_check.hpp"
#include "service/pipeline/point_cloud.hpp"
#include "service/pipeline/segment_report.hpp"
#include "service/pipeline/surfaces.hpp"

namespace graspd {

/// How far a cloud got.
enum class DetectionStatus { kOk, kEmptyCloud, kNoFinitePoints, kNothingInWorkspace, kNoHandles };

/// Handles, and how the method came to them.
struct Detection {
  DetectionStatus status = DetectionStatus::kEmptyCloud;
  std::pmr::vector<Handle> handles;                      ///< best first, in the cloud's frame
  int points_in = 0;                                     ///< of the cloud
  int points_used = 0;                                   ///< after workspace filter and downsampling
  int num_candidates = 0;                                ///< gripper poses accepted or refused
  FailureCounts candidate_failures{};                    ///< by the first check a candidate failed
  std::pmr::vector<SegmentReport> segments;              ///< what became of each
  [[nodiscard]] FailureCounts segment_failures() const;  ///< segments without a handle, by their reason
};

/// Finds the handles of a cloud. The result depends on the arguments alone, to the bit, for any number of
/// threads; work is split over the calling thread's oneTBB arena. Who wants to see them is given the surfaces
/// that the handles were looked for on; without points to work on these stay as they are.
[[nodiscard]] Detection detect_handles(const PointCloud& cloud, const Gripper& gripper,
                                       const DetectConfig& config, const StageObserver& observer = {},
                                       Surfaces* seen_surfaces = nullptr);

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/detect_handles.hpp"

namespace graspd {

Detection detect_handles(const PointCloud& cloud, const Gripper&, const DetectConfig& config,
                         const StageObserver& observer) {
  Detection d;
  d.points_in = static_cast<int>(cloud.size());
  if (cloud.empty()) return d;
  const WorkspaceResult kept = filter_workspace(cloud, config.workspace);
  if (observer) observer("workspace_filter");
  d.points_used = static_cast<int>(kept.cloud.size());
  d.status = kept.num_finite == 0       ? DetectionStatus::kNoFinitePoints
             : kept.cloud.empty() ? DetectionStatus::kNothingInWorkspace
                                  : DetectionStatus::kNoHandles;
  return d;
}

}  // namespace graspd

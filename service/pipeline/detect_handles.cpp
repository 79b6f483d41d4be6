// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/detect_handles.hpp"

#include <optional>
#include <utility>

#include "service/pipeline/find_handles.hpp"
#include "service/pipeline/run_beside.hpp"
#include "service/pipeline/surfaces.hpp"

namespace graspd {

std::optional<ConfigProblem> DetectConfig::validate() const {
  const float ratio = neighborhoods.radius_m / downsample.leaf_size_m;
  if (ratio < 1.5f || ratio > 8)
    return ConfigProblem{"neighborhoods.radius_m", "expected 1.5 to 8 times downsample.leaf_size_m"};
  return std::nullopt;
}

FailureCounts Detection::segment_failures() const {
  FailureCounts counts{};
  for (const SegmentReport& segment : segments)
    if (segment.num_handles == 0) ++counts[static_cast<std::size_t>(segment.reason())];
  return counts;
}

Detection detect_handles(const PointCloud& cloud, const Gripper& gripper, const DetectConfig& config,
                         const StageObserver& observer, Surfaces* seen_surfaces) {
  const auto done = [&observer](std::string_view stage) {
    if (observer) observer(stage);
  };
  Detection detection;
  detection.points_in = static_cast<int>(cloud.size());
  if (cloud.empty()) return detection;
  const WorkspaceResult kept = filter_workspace(cloud, config.workspace);
  done("workspace_filter");
  detection.status =
      kept.num_finite == 0 ? DetectionStatus::kNoFinitePoints : DetectionStatus::kNothingInWorkspace;
  if (kept.cloud.empty()) return detection;

  // Beside the surfaces, many of whose stages leave threads free.
  std::optional<DepthMap> depth_map;
  Surfaces surfaces;
  run_beside([&] { depth_map.emplace(kept.cloud, kept.pixels); },
             [&] { surfaces = find_surfaces(kept.cloud, config, done, kept.pixels); });
  done("index");
  detection.points_used = static_cast<int>(surfaces.cloud.size());
  FoundHandles found = find_handles(kept.cloud, *depth_map, surfaces, gripper, config);
  detection.num_candidates = found.num_tried;
  detection.candidate_failures = found.failures;
  detection.segments = std::move(found.segments);
  detection.handles = std::move(found.handles);
  detection.status = detection.handles.empty() ? DetectionStatus::kNoHandles : DetectionStatus::kOk;
  done("handles");
  if (seen_surfaces != nullptr) *seen_surfaces = std::move(surfaces);
  return detection;
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Fits a candidate to the object: the patch between the gaps on both sides (paper, section 5), its middle,
// top and width.
#pragma once
#include <array>

#include "service/pipeline/handle_check.hpp"

namespace graspd {

struct PatchFit {
  float center_m = 0;  ///< middle of the patch along the closing axis, from the candidate's position
  float top_m = 0;     ///< the handle's depth from the candidate's position
  float width_m = 0;   ///< of the patch
  std::array<float, 2> gap_m{};  ///< free beside it on both sides, at most d
};

/// How deep the object must reach between the jaws [m]: what lies on the support may be lower than
/// min_grip_depth_m; then it is held by most of its height. top: the object's, in the cloud's frame;
/// approach: unit.
[[nodiscard]] float least_grip_depth(const Plane* support, const HandleCheckConfig& config,
                                     const Eigen::Vector3f& top, const Eigen::Vector3f& approach);

/// Gathers the points around the candidate into buffers (relative to the fitted position) and fits. The
/// fingertips go l below the patch's top, or less deep where the support or something else is in their way.
[[nodiscard]] Failure fit_patch(const SceneView& scene, const Gripper& gripper,
                                const HandleCheckConfig& config, const Candidate& candidate,
                                CheckBuffers& buffers, PatchFit& fit);

}  // namespace graspd

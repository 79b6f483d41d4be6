// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What a promising candidate is worth beyond passing the checks: turned square to its object, and how steady
// it is.
#pragma once
#include "service/pipeline/handle_check.hpp"

namespace graspd {

/// check_candidate, and where the jaws do not meet the object squarely up to twice more with a closing axis
/// that does; the result with the best score counts.
[[nodiscard]] CheckResult check_squarely(const SceneView& scene, const Gripper& gripper,
                                         const HandleCheckConfig& config, const Candidate& candidate,
                                         CheckBuffers& buffers);

/// place: of a handle. Share of four poses next to it that hold, too: 3 mm both ways along its major axis, 5
/// degrees both ways about its approach. The robot and the cloud are a little off.
[[nodiscard]] float steadiness(const SceneView& scene, const Gripper& gripper,
                               const HandleCheckConfig& config, const Candidate& place,
                               CheckBuffers& buffers);

}  // namespace graspd

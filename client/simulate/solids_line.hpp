// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The true solids that a simulated camera looks at, one line of JSON for each frame.
#pragma once
#include <cstdint>
#include <string>

#include "client/simulate/scene.hpp"

namespace graspd {

/// {"seq": 3, "T_world_camera": POSE, "solids": [{"kind": "mug", "label": 20, "T_world_solid": POSE,
/// "parts": [BODY, ...], "cavity": BODY}, ...]}, a cavity only where there is one.
/// POSE is {"position": [x, y, z], "orientation": [w, x, y, z]}, w >= 0, metres. BODY is in the solid's
/// frame: what client/simulate/convex.hpp names, its type in lower_snake and then its members.
[[nodiscard]] std::string solids_line(std::int64_t seq, const Scene& scene,
                                      const Eigen::Isometry3d& T_world_camera);

}  // namespace graspd

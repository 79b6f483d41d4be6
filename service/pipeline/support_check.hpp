// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Whether the gripper stays clear of what objects stand on.
#pragma once
#include "service/pipeline/handle_check.hpp"

namespace graspd {

/// The fingertips stay as high as configured above the plane that the object stands on, the hand above it on
/// its whole way in, and neither goes through another level. half_m: of the opening; object: the handle's.
[[nodiscard]] bool is_clear_of_support(const SceneView& scene, const Gripper& gripper,
                                       const HandleCheckConfig& config, const Handle& handle, float half_m,
                                       std::int32_t object);

}  // namespace graspd

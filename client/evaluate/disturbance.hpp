// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Whether a handle still holds when the robot is a little off.
#pragma once
#include <array>

#include "client/evaluate/label_judge.hpp"

namespace graspd {

inline constexpr int kDisturbances = 12;

/// The handle moved by 3 mm along, and turned by 5 degrees about, each axis of the gripper, both ways.
[[nodiscard]] std::array<Handle, kDisturbances> disturbed(const Handle& handle);

/// How many of them are valid; stops counting when `wanted` are, or can no longer be.
[[nodiscard]] int valid_disturbances(const LabelScene& scene, const Gripper& gripper, const Handle& handle,
                                     int wanted = kDisturbances);

}  // namespace graspd

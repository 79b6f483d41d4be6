// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What a handle would really do: the gripper's volumes against the exact solids of a scene.
#pragma once
#include "service/pipeline/gripper.hpp"
#include "service/pipeline/handle.hpp"
#include "service/pipeline/handle_check.hpp"
#include "tests/support/analytic_scene.hpp"

namespace graspd {

struct HandleTruth {
  int solid = -1;             ///< index of the one between the jaws with the most of it there; -1: none
  int num_between = 0;        ///< solids between the jaws
  double width_m = 0;         ///< extent of the solid along the closing axis, between the jaws
  double center_m = 0;        ///< its middle, from the handle's position along the closing axis
  double grip_depth_m = 0;    ///< how deep the solid reaches between the jaws, from its top to the fingertips
  double surface_m = 0;       ///< distance of the handle's position from the solid's surface
  double finger_depth_m = 0;  ///< how deep the fingers go into any solid; negative: free by this much
  double hand_depth_m = 0;    ///< the same for the palm, and for the hand on its way in
};

/// check: how far the jaws open beyond the object, and how much of the hand comes in behind the fingers.
/// Solid 0 is the table: it is never held.
[[nodiscard]] HandleTruth judge(const Handle& handle, const Gripper& gripper, const HandleCheckConfig& check,
                                const AnalyticScene& scene);

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/gripper.hpp"

namespace graspd {

std::optional<ConfigProblem> Gripper::validate() const {
  if (min_gap_m <= finger_width_m)
    return ConfigProblem{"min_gap_m", "a finger must fit into the gap: expected more than finger_width_m"};
  if (grasp_depth_m >= finger_length_m)
    return ConfigProblem{"grasp_depth_m",
                         "the palm would hit the object: expected less than finger_length_m"};
  return std::nullopt;
}

}  // namespace graspd

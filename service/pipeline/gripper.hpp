// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The geometry of a two-finger parallel-jaw gripper (paper, section 3 and figure 1).
#pragma once
#include <optional>
#include <string>

#include "service/pipeline/config_fields.hpp"

namespace graspd {

/// Lengths in metres; the letters are the paper's. The defaults are the paper's gripper.
struct Gripper {
  std::string name = "paper_80mm";
  float aperture_m = 0.080f;          ///< d: largest distance between the fingers
  float finger_width_m = 0.010f;      ///< w: of a finger along the closing axis
  float finger_thickness_m = 0.020f;  ///< e: of a finger along the major axis
  float finger_length_m = 0.060f;     ///< h: from the palm to the fingertips
  float grasp_depth_m = 0.030f;       ///< l: how far the fingertips go below the object's visible surface
  float min_gap_m = 0.012f;           ///< g: smallest free gap beside the object, more than w

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& v) {
    v("name", self.name, Range{}, "name that handle lists carry");
    v("aperture_m", self.aperture_m, Range{0.005, 0.5}, "d: largest distance between the fingers [m]");
    v("finger_width_m", self.finger_width_m, Range{0.001, 0.1}, "w: of a finger along the closing axis [m]");
    v("finger_thickness_m", self.finger_thickness_m, Range{0.002, 0.1},
      "e: of a finger along the major axis [m]");
    v("finger_length_m", self.finger_length_m, Range{0.005, 0.5}, "h: from the palm to the fingertips [m]");
    v("grasp_depth_m", self.grasp_depth_m, Range{0.003, 0.5},
      "l: fingertips below the object's visible surface [m]");
    v("min_gap_m", self.min_gap_m, Range{0.001, 0.2},
      "g: smallest free gap beside the object [m], more than w");
  }

  /// The paper's rules between the lengths: g > w and l < h.
  [[nodiscard]] std::optional<ConfigProblem> validate() const;
};

}  // namespace graspd

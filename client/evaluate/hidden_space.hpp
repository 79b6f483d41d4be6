// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What the sensor has not seen of where a hand goes, and by what it is hidden.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "client/evaluate/grip_geometry.hpp"
#include "client/evaluate/label_scene.hpp"

namespace graspd {

/// Shares of a volume [0, 1].
struct HiddenShare {
  float by_object = 0;  ///< behind the object to be held
  float by_others = 0;  ///< behind anything else

  [[nodiscard]] float all() const { return by_object + by_others; }
};

[[nodiscard]] HiddenShare hidden_share(const LabelScene& scene, const Handle& handle, const LocalBox& box,
                                       int object);

/// Whether most of an object's border towards one side ends only because something nearer hides the rest.
/// border: points in the handle's frame; side: -1 at -y, +1 at +y.
[[nodiscard]] bool is_occlusion_border(const LabelScene& scene, const Handle& handle, int object,
                                       const std::vector<Eigen::Vector3f>& border, int side);

}  // namespace graspd

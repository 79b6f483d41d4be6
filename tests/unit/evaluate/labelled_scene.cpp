// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/evaluate/labelled_scene.hpp"

#include <cmath>

namespace graspd {

LabelledCloud labelled(const AnalyticScene& scene) {
  RenderedScene rendered = render(scene);
  LabelledCloud result;
  for (const int solid : rendered.solid_of_point)
    result.label.push_back(solid < 0 ? 0 : solid == 0 ? 1 : 10 * static_cast<std::uint32_t>(solid + 1));
  result.cloud = std::move(rendered.cloud);
  return result;
}

Handle from_above(const Eigen::Vector3f& position, float width_m, float yaw_rad) {
  Handle handle;
  handle.position = position;
  handle.rotation.col(1) = Eigen::Vector3f(std::cos(yaw_rad), std::sin(yaw_rad), 0);
  handle.rotation.col(2) = -Eigen::Vector3f::UnitZ();
  handle.rotation.col(0) = handle.rotation.col(1).cross(handle.rotation.col(2));
  handle.width_m = width_m;
  return handle;
}

Handle on_box() {
  return from_above({0, 0, 0.08f}, 0.05f);
}

}  // namespace graspd

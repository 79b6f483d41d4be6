// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/evaluate/solid_scenes.hpp"

#include "service/pipeline/gripper.hpp"

namespace graspd {

using Eigen::Vector3d;

Scene bare_table() {
  Solid table;
  table.kind = "table";
  table.label = kLabelSupport;
  table.parts.emplace_back(Box{{0, 0, -0.05}, {0.5, 0.5, 0.05}});
  return {{table}};
}

void add_body(Scene& scene, const Convex& part, const Vector3d& position, double yaw_rad) {
  Solid solid;
  solid.kind = "body";
  solid.label = object_label(kFirstObject + static_cast<std::uint32_t>(scene.solids.size()) - 1);
  solid.parts.push_back(part);
  solid.T_world_solid.translation() = position;
  solid.T_world_solid.rotate(Eigen::AngleAxisd(yaw_rad, Vector3d::UnitZ()));
  scene.solids.push_back(solid);
}

Handle handle_at(const Vector3d& position, const Vector3d& approach, const Vector3d& closing,
                 double width_m) {
  const Vector3d z = approach.normalized();
  const Vector3d y = (closing - closing.dot(z) * z).normalized();
  Eigen::Matrix3d rotation;
  rotation << y.cross(z), y, z;
  Handle handle;
  handle.position = position.cast<float>();
  handle.rotation = rotation.cast<float>();
  handle.width_m = static_cast<float>(width_m);
  return handle;
}

Handle handle_from_above(double x, double y, double tip_z, double width_m) {
  return handle_at({x, y, tip_z + double{Gripper{}.grasp_depth_m}}, -Vector3d::UnitZ(), Vector3d::UnitX(),
                   width_m);
}

}  // namespace graspd

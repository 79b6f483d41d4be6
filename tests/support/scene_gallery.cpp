// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/scene_gallery.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace graspd {
namespace {

Eigen::Isometry3d placed(double x, double y, double z, double yaw_rad) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(x, y, z);
  pose.linear() = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return pose;
}

}  // namespace

AnalyticSolid table() {
  return {SolidShape::kHalfSpace, Eigen::Vector3d::Ones(), Eigen::Isometry3d::Identity()};
}

AnalyticSolid standing_box(double x, double y, const Eigen::Vector3d& edges, double yaw_rad) {
  return {SolidShape::kBox, 0.5 * edges, placed(x, y, 0.5 * edges.z(), yaw_rad)};
}

AnalyticSolid standing_cylinder(double x, double y, double radius, double height) {
  return {SolidShape::kCylinder, {radius, radius, 0.5 * height}, placed(x, y, 0.5 * height, 0)};
}

AnalyticSolid lying_cylinder(double x, double y, double radius, double length, double yaw_rad) {
  AnalyticSolid solid{SolidShape::kCylinder, {radius, radius, 0.5 * length}, placed(x, y, radius, yaw_rad)};
  solid.T_scene_solid.rotate(Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitY()));
  return solid;
}

AnalyticScene on_table(std::vector<AnalyticSolid> objects) {
  AnalyticScene scene;
  scene.solids = std::move(objects);
  scene.solids.insert(scene.solids.begin(), table());
  scene.camera.T_scene_camera = looking_at({0, -0.45, 0.56}, {0, 0, 0.03});
  return scene;
}

AnalyticScene box_on_table() {
  return on_table({standing_box(0, 0, {0.05, 0.12, 0.08})});
}

AnalyticScene cylinder_on_table() {
  return on_table({standing_cylinder(0, 0, 0.03, 0.12)});
}

AnalyticScene lying_cylinder_on_table() {
  return on_table({lying_cylinder(0, 0, 0.025, 0.14)});
}

AnalyticScene bottle_beside_box() {
  return on_table({standing_cylinder(-0.06, 0, 0.03, 0.18), standing_box(0.045, 0, {0.15, 0.12, 0.07})});
}

AnalyticScene touching_boxes() {
  return on_table({standing_box(-0.025, 0, {0.05, 0.10, 0.10}), standing_box(0.025, 0, {0.05, 0.10, 0.06})});
}

AnalyticScene too_wide_box() {
  return on_table({standing_box(0, 0, {0.12, 0.12, 0.10})});
}

AnalyticScene wedged_boxes() {
  return on_table({standing_box(-0.05, 0, {0.05, 0.12, 0.08}), standing_box(0, 0, {0.05, 0.12, 0.08}),
                   standing_box(0.05, 0, {0.05, 0.12, 0.08})});
}

AnalyticScene wall_of_boxes() {
  std::vector<AnalyticSolid> objects;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      AnalyticSolid box = standing_box(0.1 * (column - 1), 0.1, {0.1, 0.1, 0.1});
      box.T_scene_solid.translation() += Eigen::Vector3d(0, 0.008 * ((row + column) % 2), 0.1 * row);
      objects.push_back(box);
    }
  objects.push_back(standing_box(0, 0.35, {1.0, 0.4, 0.3}));
  AnalyticScene scene = on_table(std::move(objects));
  scene.camera.T_scene_camera = looking_at({0, -0.6, 0.25}, {0, 0.1, 0.12});
  return scene;
}

AnalyticScene three_objects() {
  return on_table({standing_box(-0.12, 0.02, {0.045, 0.11, 0.07}, 0.4),
                   lying_cylinder(0.02, -0.05, 0.022, 0.12, -0.3),
                   standing_cylinder(0.13, 0.03, 0.027, 0.10)});
}

AnalyticScene block_on_table() {
  std::vector<AnalyticSolid> solids{
      standing_box(0.2, 0.05, {0.4, 0.26, 0.12}), standing_box(0.12, 0.04, {0.05, 0.12, 0.08}),
      standing_cylinder(-0.12, -0.02, 0.03, 0.12), standing_box(-0.24, 0.03, {0.04, 0.10, 0.06})};
  solids[1].T_scene_solid.translation().z() += 0.12;
  AnalyticScene scene = on_table(std::move(solids));
  scene.camera = {looking_at({0, -0.6, 0.7}, {0, 0, 0.05}), 400, 300, 400};
  return scene;
}

AnalyticScene shelf() {
  constexpr double kBoard = 0.32;
  std::vector<AnalyticSolid> solids{
      standing_box(0, 0, {0.7, 0.28, 0.018}),         standing_box(0, 0.19, {0.7, 0.1, 0.4}),
      standing_box(-0.15, -0.02, {0.05, 0.10, 0.08}), standing_cylinder(0.15, -0.02, 0.03, 0.12),
      standing_box(0.1, -0.04, {0.05, 0.10, 0.08}),   standing_cylinder(-0.12, -0.04, 0.03, 0.12)};
  for (const std::size_t k : {0u, 2u, 3u}) solids[k].T_scene_solid.translation().z() += kBoard;
  solids[0].T_scene_solid.translation().z() -= 0.018;
  AnalyticScene scene = on_table(std::move(solids));
  // The lower board ends where the upper one does.
  scene.solids[0] = standing_box(0, 0, {0.7, 0.28, 0.018});
  scene.solids[0].T_scene_solid.translation().z() -= 0.018;
  scene.camera = {looking_at({0, -0.75, 0.75}, {0, 0, 0.2}), 400, 300, 400};
  return scene;
}

AnalyticScene spread_objects() {
  std::vector<AnalyticSolid> objects;
  for (int i = 0; i < 9; ++i) {
    const double x = 0.19 * (i % 3 - 1), y = 0.17 * (i / 3 - 1), yaw = 0.37 * i;
    if (i % 3 == 0) objects.push_back(standing_box(x, y, {0.05, 0.10, 0.06 + 0.005 * i}, yaw));
    if (i % 3 == 1) objects.push_back(lying_cylinder(x, y, 0.02 + 0.001 * i, 0.12, yaw));
    if (i % 3 == 2) objects.push_back(standing_cylinder(x, y, 0.02 + 0.001 * i, 0.09));
  }
  AnalyticScene scene = on_table(std::move(objects));
  scene.camera = {looking_at({0, -0.55, 0.72}, {0, 0, 0}), 640, 480, 570};
  return scene;
}

}  // namespace graspd

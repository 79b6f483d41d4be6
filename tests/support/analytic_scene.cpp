// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/analytic_scene.hpp"

#include <limits>

namespace graspd {

Eigen::Isometry3d looking_at(const Eigen::Vector3d& eye, const Eigen::Vector3d& target) {
  const Eigen::Vector3d forward = (target - eye).normalized();
  Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ());
  if (right.norm() < 1e-6) right = Eigen::Vector3d::UnitX();
  right.normalize();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear().col(0) = right;
  pose.linear().col(1) = forward.cross(right);
  pose.linear().col(2) = forward;
  pose.translation() = eye;
  return pose;
}

RenderedScene render(const AnalyticScene& scene) {
  const AnalyticCamera& camera = scene.camera;
  const Eigen::Vector3d eye = camera.T_scene_camera.translation();
  constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();
  RenderedScene rendered;
  rendered.cloud.viewpoint = eye.cast<float>();
  rendered.cloud.width = camera.width;
  rendered.cloud.height = camera.height;
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector3d pixel((u + 0.5 - 0.5 * camera.width) / camera.focal_px,
                                  (v + 0.5 - 0.5 * camera.height) / camera.focal_px, 1);
      const Eigen::Vector3d ray = camera.T_scene_camera.linear() * pixel;
      double nearest = std::numeric_limits<double>::infinity();
      int solid = -1;
      for (std::size_t i = 0; i < scene.solids.size(); ++i) {
        const auto chord = intersect(scene.solids[i], eye, ray);
        if (!chord || chord->enter <= 0 || chord->enter >= nearest) continue;
        nearest = chord->enter;
        solid = static_cast<int>(i);
      }
      Eigen::Vector3f hit = Eigen::Vector3f::Constant(kMissing);
      if (solid >= 0) hit = (eye + nearest * ray).cast<float>();
      rendered.cloud.push_back(hit);
      rendered.solid_of_point.push_back(solid);
    }
  return rendered;
}

AnalyticScene moved(const AnalyticScene& scene, const Eigen::Isometry3d& T) {
  AnalyticScene result = scene;
  for (AnalyticSolid& solid : result.solids) solid.T_scene_solid = T * solid.T_scene_solid;
  result.camera.T_scene_camera = T * scene.camera.T_scene_camera;
  return result;
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/simulate/depth_camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace graspd {
namespace {

using Eigen::Vector3d;

/// Pixels [u_min, u_max) x [v_min, v_max).
struct Window {
  int u_min, u_max, v_min, v_max;
};

/// Holds every pixel whose ray can meet the box; the whole image where the box reaches behind the camera.
Window window_of(const Eigen::AlignedBox3d& box, const Eigen::Isometry3d& T_camera_solid,
                 const Pinhole& camera) {
  constexpr double kNear = 1e-3;
  double low_u = std::numeric_limits<double>::infinity(), low_v = low_u;
  double high_u = -low_u, high_v = -low_u;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d p = T_camera_solid * box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner));
    if (p.z() < kNear) return {0, camera.width, 0, camera.height};
    const double u = camera.fx * p.x() / p.z() + camera.cx;
    const double v = camera.fy * p.y() / p.z() + camera.cy;
    low_u = std::min(low_u, u);
    high_u = std::max(high_u, u);
    low_v = std::min(low_v, v);
    high_v = std::max(high_v, v);
  }
  const auto limit = [](double value, int size) {
    return static_cast<int>(std::clamp(value, 0.0, double(size)));
  };
  return {limit(std::floor(low_u), camera.width), limit(std::ceil(high_u) + 1, camera.width),
          limit(std::floor(low_v), camera.height), limit(std::ceil(high_v) + 1, camera.height)};
}

std::uint32_t shaded(std::uint32_t rgb, double cos_incidence) {
  const double light = 0.35 + 0.65 * cos_incidence;
  std::uint32_t result = 0;
  for (const int shift : {16, 8, 0}) {
    result |= static_cast<std::uint32_t>(((rgb >> shift) & 0xff) * light) << shift;
  }
  return result;
}

/// Draws one part over what is in the frame so far.
void draw(const Solid& solid, const Convex& part, const Eigen::Isometry3d& T_camera_solid,
          DepthFrame& frame) {
  const Pinhole& camera = frame.camera;
  const Window window = window_of(bounds(part), T_camera_solid, camera);
  const Eigen::Isometry3d T_solid_camera = T_camera_solid.inverse();
  const Eigen::Matrix3d& turn = T_solid_camera.linear();
  Ray ray;
  ray.origin = T_solid_camera.translation();
  for (int v = window.v_min; v < window.v_max; ++v) {
    const Vector3d row = turn.col(2) + turn.col(1) * ((v - camera.cy) / camera.fy);
    for (int u = window.u_min; u < window.u_max; ++u) {
      // The direction's z is 1 in the optical frame, so that t is the depth.
      ray.direction = row + turn.col(0) * ((u - camera.cx) / camera.fx);
      const auto crossing = first_crossing(part, solid.cavity, ray);
      if (!crossing) continue;
      const auto i =
          static_cast<std::size_t>(v) * static_cast<std::size_t>(camera.width) + static_cast<std::size_t>(u);
      const auto depth = static_cast<float>(crossing->t);
      if (frame.depth_m[i] > 0 && frame.depth_m[i] <= depth) continue;
      const double cosine = std::abs(crossing->normal.dot(ray.direction)) / ray.direction.norm();
      frame.depth_m[i] = depth;
      frame.label[i] = solid.label;
      frame.rgb[i] = shaded(solid.rgb, cosine);
      frame.cos_incidence[i] = static_cast<float>(cosine);
    }
  }
}

}  // namespace

Eigen::Isometry3d look_at(const Vector3d& eye, const Vector3d& target) {
  const Vector3d forward = (target - eye).normalized();
  // Looking straight down or up, the image's right is the world's x.
  Vector3d right = forward.cross(Vector3d::UnitZ());
  right = right.norm() > 1e-6 ? right.normalized() : Vector3d::UnitX();
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  T_world_camera.linear().col(0) = right;
  T_world_camera.linear().col(1) = forward.cross(right);
  T_world_camera.linear().col(2) = forward;
  T_world_camera.translation() = eye;
  return T_world_camera;
}

DepthFrame render(const Scene& scene, const Pinhole& camera, const Eigen::Isometry3d& T_world_camera) {
  const std::size_t n = static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
  DepthFrame frame{camera, std::vector<float>(n, 0.0f), std::vector<std::uint32_t>(n, kLabelInvalid),
                   std::vector<std::uint32_t>(n, 0), std::vector<float>(n, 0.0f)};
  const Eigen::Isometry3d T_camera_world = T_world_camera.inverse();
  for (const Solid& solid : scene.solids) {
    const Eigen::Isometry3d T_camera_solid = T_camera_world * solid.T_world_solid;
    for (const Convex& part : solid.parts) draw(solid, part, T_camera_solid, frame);
  }
  return frame;
}

LabelledCloud to_cloud(const DepthFrame& frame) {
  const Pinhole& camera = frame.camera;
  LabelledCloud result;
  result.cloud.width = camera.width;
  result.cloud.height = camera.height;
  result.cloud.resize(frame.size());
  result.rgb = frame.rgb;
  result.label = frame.label;
  std::size_t i = 0;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u, ++i) {
      const float z = frame.depth_m[i] > 0 ? frame.depth_m[i] : std::numeric_limits<float>::quiet_NaN();
      result.cloud.x[i] = static_cast<float>((u - camera.cx) / camera.fx * double(z));
      result.cloud.y[i] = static_cast<float>((v - camera.cy) / camera.fy * double(z));
      result.cloud.z[i] = z;
    }
  }
  return result;
}

}  // namespace graspd

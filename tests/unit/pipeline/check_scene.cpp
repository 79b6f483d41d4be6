// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/pipeline/check_scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/support/clouds.hpp"

namespace graspd {
namespace {

float radians(float degrees) {
  return degrees * std::numbers::pi_v<float> / 180;
}

}  // namespace

CheckScene::CheckScene(const AnalyticScene& scene)
    : cloud_(finite_points(render(scene).cloud)),
      surfaces_(find_surfaces(cloud_, {}, [](std::string_view) {})),
      depth_map_(cloud_),
      view_{cloud_,
            surfaces_.points,
            surfaces_.objects.of_point,
            surfaces_.normals,
            surfaces_.voxel_of_point,
            surfaces_.support,
            depth_map_,
            surfaces_.voxel_of_point,
            4,
            12} {}

Candidate CheckScene::candidate(const Eigen::Vector3f& position, const Eigen::Vector3f& approach,
                                const Eigen::Vector3f& closing) const {
  Candidate candidate;
  candidate.position = position;
  candidate.rotation << closing.cross(approach), closing, approach;
  candidate.segment = 0;
  float nearest = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < cloud_.size(); ++i) {
    const float distance = (cloud_.point(i) - position).squaredNorm();
    if (object_of(i) < 0 || distance >= nearest) continue;
    nearest = distance;
    candidate.object = object_of(i);
  }
  return candidate;
}

float CheckScene::hidden_share(const Candidate& candidate, const Gripper& gripper, float f_m,
                               float side) const {
  int hidden = 0, all = 0;
  for (float a = -0.4f; a < 0.5f; a += 0.2f)
    for (float f = 0.004f; f < 0.004f + gripper.finger_width_m; f += 0.001f)
      for (float z = 0.001f; z < gripper.grasp_depth_m; z += 0.001f) {
        const Eigen::Vector3f place(a * gripper.finger_thickness_m, f_m + side * f, z);
        const Eigen::Vector3f p = candidate.position + candidate.rotation * place;
        hidden += depth_map_.hider(p, DepthMap::kHideMargin) != DepthMap::kFree ? 1 : 0;
        ++all;
      }
  return static_cast<float>(hidden) / static_cast<float>(all);
}

std::array<Contact, 2> CheckScene::contacts(const Candidate& candidate, const Gripper& gripper) const {
  const float half_e = 0.5f * gripper.finger_thickness_m, l = gripper.grasp_depth_m;
  const HandleCheckConfig limits;
  LocalPoints local;
  surfaces_.points.find(candidate.position, candidate.rotation,
                        {-half_e, -gripper.aperture_m, l - gripper.finger_length_m},
                        {half_e, gripper.aperture_m, l}, local);
  std::pmr::vector<std::uint32_t> between;
  std::pmr::vector<Eigen::Vector2f> profile;
  float low = 1, high = -1, top = 1;
  for (std::uint32_t k = 0; k < local.size(); ++k) {
    if (object_of(local.index[k]) != candidate.object) continue;
    between.push_back(k);
    profile.emplace_back(local.f[k], local.z[k]);
    low = std::min(low, local.f[k]);
    high = std::max(high, local.f[k]);
    top = std::min(top, local.z[k]);
  }
  const ContactInput input{view_,
                           local,
                           between,
                           candidate.position,
                           candidate.rotation,
                           top,
                           l,
                           high - low,
                           std::cos(radians(limits.max_facing_angle_deg)),
                           gripper.finger_width_m,
                           gripper.finger_thickness_m,
                           depth_map_.ray_area(candidate.position),
                           radians(limits.max_wall_angle_deg),
                           fit_circle(profile, kMaxRadius, circle_tolerance(view_))};
  EndFace face;
  return {find_contact(input, -1, low, hidden_share(candidate, gripper, low, -1), face),
          find_contact(input, 1, high, hidden_share(candidate, gripper, high, 1), face)};
}

}  // namespace graspd

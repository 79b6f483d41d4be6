// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/unseen_share.hpp"

namespace graspd {
namespace {

bool counts(const SceneView& scene, std::int32_t hider, Hidden what, std::int32_t object) {
  if (hider == DepthMap::kFree) return false;
  if (hider == DepthMap::kOutOfView) return what == Hidden::kAtAll;
  return what != Hidden::kByOthers || scene.object_at(hider) != object;
}

}  // namespace

float hidden_share(const SceneView& scene, const Handle& handle, float thickness_m, const HandBox& box,
                   Hidden what, std::int32_t object) {
  constexpr std::size_t kDepths = kProbes;
  Probes places;
  std::int32_t hiders[kDepths];
  int samples = 0, hidden = 0;
  const Eigen::Matrix3f& R = handle.rotation;
  const Eigen::Vector3f& p = handle.position;
  for (const float a : {-0.4f, 0.0f, 0.4f})
    for (const float s : {0.1f, 0.5f, 0.9f}) {
      const float along = a * thickness_m, f = box.from_f + (box.to_f - box.from_f) * s;
      for (std::size_t k = 0; k < kDepths; ++k) {
        const float z = box.from_z + (box.to_z - box.from_z) * (static_cast<float>(k) + 0.5f) / kDepths;
        places.x[k] = p.x() + (R(0, 0) * along + R(0, 1) * f + R(0, 2) * z);
        places.y[k] = p.y() + (R(1, 0) * along + R(1, 1) * f + R(1, 2) * z);
        places.z[k] = p.z() + (R(2, 0) * along + R(2, 1) * f + R(2, 2) * z);
      }
      scene.depth_map.find_hiders(places, DepthMap::kHideMargin, hiders);
      for (const std::int32_t hider : hiders) {
        ++samples;
        hidden += counts(scene, hider, what, object) ? 1 : 0;
      }
    }
  return static_cast<float>(hidden) / static_cast<float>(samples);
}

}  // namespace graspd

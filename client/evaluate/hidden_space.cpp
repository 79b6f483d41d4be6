// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/hidden_space.hpp"

#include <algorithm>
#include <limits>

namespace graspd {
namespace {

constexpr float kBehind = 0.008f;    // a point is hidden by what is nearer by more than this [m]
constexpr float kBeside = 0.008f;    // from the border, in the image [m]
constexpr std::size_t kSamples = 4;  // along the short edges of a box; twice as many along the approach

float sample(float min, float max, std::size_t i, std::size_t n) {
  return min + (max - min) * (static_cast<float>(i) + 0.5f) / static_cast<float>(n);
}

/// The side as the sensor sees it; shorter, the more it points along the line of sight.
Eigen::Vector3f across_view(const Eigen::Vector3f& side, const Eigen::Vector3f& line_of_sight) {
  return side - side.dot(line_of_sight) * line_of_sight;
}

}  // namespace

HiddenShare hidden_share(const LabelScene& scene, const Handle& handle, const LocalBox& box, int object) {
  int own = 0, others = 0;
  for (std::size_t i = 0; i < kSamples; ++i) {
    for (std::size_t j = 0; j < kSamples; ++j) {
      for (std::size_t k = 0; k < 2 * kSamples; ++k) {
        const Eigen::Vector3f local(sample(box.min.x(), box.max.x(), i, kSamples),
                                    sample(box.min.y(), box.max.y(), j, kSamples),
                                    sample(box.min.z(), box.max.z(), k, 2 * kSamples));
        const auto hider = scene.depth_map().hider(handle.position + handle.rotation * local, kBehind);
        if (hider == DepthMap::kFree) continue;
        ++(scene.object_of(static_cast<std::uint32_t>(hider)) == object ? own : others);
      }
    }
  }
  constexpr float kAll = 2 * kSamples * kSamples * kSamples;
  return {static_cast<float>(own) / kAll, static_cast<float>(others) / kAll};
}

bool is_occlusion_border(const LabelScene& scene, const Handle& handle, int object,
                         const std::vector<Eigen::Vector3f>& border, int side) {
  float end = std::numeric_limits<float>::lowest();
  for (const Eigen::Vector3f& p : border) end = std::max(end, static_cast<float>(side) * p.y());
  std::size_t asked = 0, hidden = 0;
  for (const Eigen::Vector3f& local : border) {
    const Eigen::Vector3f p = handle.position + handle.rotation * local;
    const Eigen::Vector3f sight = (p - scene.cloud().viewpoint).normalized();
    const Eigen::Vector3f beside = across_view(static_cast<float>(side) * handle.rotation.col(1), sight);
    if (beside.norm() < 0.3f) continue;  // there is no beside: the jaw is behind or before the object
    const float to_end = end - static_cast<float>(side) * local.y();
    const auto hider = scene.depth_map().hider(p + (kBeside + to_end) * beside.normalized(), kBehind);
    ++asked;
    if (hider == DepthMap::kFree) continue;
    hidden += scene.object_of(static_cast<std::uint32_t>(hider)) != object ? 1 : 0;
  }
  return asked > 0 && 2 * hidden > asked;
}

}  // namespace graspd

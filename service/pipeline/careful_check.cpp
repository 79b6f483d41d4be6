// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/careful_check.hpp"

namespace graspd {
namespace {

/// The same place with the closing axis that the check found to meet the object squarely.
Candidate squared(const Candidate& candidate, const CheckResult& result) {
  Candidate better = candidate;
  const Eigen::Vector3f y = result.squared_axis;
  const Eigen::Vector3f x = result.handle.rotation.col(0);
  better.position = result.handle.position;
  better.rotation.col(1) = y;
  better.rotation.col(0) = (x - x.dot(y) * y).normalized();
  better.rotation.col(2) = better.rotation.col(0).cross(y);
  return better;
}

}  // namespace

CheckResult check_squarely(const SceneView& scene, const Gripper& gripper, const HandleCheckConfig& config,
                           const Candidate& candidate, CheckBuffers& buffers) {
  constexpr float kSquareCosine = 0.9986f;  // 3 degrees
  CheckResult result = check_candidate(scene, gripper, config, candidate, buffers);
  for (int round = 0; round < 2 && result.failure == Failure::kNone; ++round) {
    if (result.squared_axis.dot(result.handle.rotation.col(1)) > kSquareCosine) break;
    const CheckResult better = check_candidate(scene, gripper, config, squared(candidate, result), buffers);
    if (better.failure != Failure::kNone || score(better.margins) <= score(result.margins)) break;
    result = better;
  }
  return result;
}

float steadiness(const SceneView& scene, const Gripper& gripper, const HandleCheckConfig& config,
                 const Candidate& place, CheckBuffers& buffers) {
  constexpr float kShift = 0.003f, kTurn = 0.087f;
  int held = 0;
  for (const float sign : {-1.0f, 1.0f}) {
    Candidate shifted = place, turned = place;
    shifted.position += sign * kShift * place.rotation.col(0);
    held += check_candidate(scene, gripper, config, shifted, buffers).failure == Failure::kNone ? 1 : 0;
    turned.rotation = place.rotation * Eigen::AngleAxisf(sign * kTurn, Eigen::Vector3f::UnitZ());
    held += check_candidate(scene, gripper, config, turned, buffers).failure == Failure::kNone ? 1 : 0;
  }
  return 0.25f * static_cast<float>(held);
}

}  // namespace graspd

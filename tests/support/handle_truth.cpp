// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/handle_truth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace graspd {
namespace {

constexpr int kAlong = 9, kDeep = 31;

/// What one solid has between the jaws.
struct Held {
  int lines = 0;
  double low = std::numeric_limits<double>::infinity(), high = -low, top = low;
};

struct Frame {
  Eigen::Isometry3d T_scene_gripper = Eigen::Isometry3d::Identity();

  explicit Frame(const Handle& handle) {
    T_scene_gripper.linear() = handle.rotation.cast<double>();
    T_scene_gripper.translation() = handle.position.cast<double>();
  }
};

Held held_part(const Frame& frame, const Gripper& gripper, double half_opening, const AnalyticSolid& solid) {
  const double e = gripper.finger_thickness_m, h = gripper.finger_length_m, l = gripper.grasp_depth_m;
  Held held;
  for (int i = 0; i < kAlong; ++i)
    for (int k = 0; k < kDeep; ++k) {
      const double z = l - h + h * k / (kDeep - 1);
      const Eigen::Vector3d origin =
          frame.T_scene_gripper * Eigen::Vector3d(e * (i + 0.5) / kAlong - 0.5 * e, 0, z);
      const auto chord = intersect(solid, origin, frame.T_scene_gripper.linear().col(1));
      if (!chord || chord->enter >= half_opening || chord->leave <= -half_opening) continue;
      ++held.lines;
      held.low = std::min(held.low, chord->enter);
      held.high = std::max(held.high, chord->leave);
      held.top = std::min(held.top, z);
    }
  return held;
}

double depth_in_solids(const AnalyticScene& scene, const Eigen::Vector3d& point) {
  double depth = -std::numeric_limits<double>::infinity();
  for (const AnalyticSolid& solid : scene.solids) depth = std::max(depth, -signed_distance(solid, point));
  return depth;
}

/// How deep a box in gripper coordinates reaches into the solids, sampled.
double box_depth(const Frame& frame, const AnalyticScene& scene, const Eigen::AlignedBox3d& box) {
  constexpr int kAcross = 9;
  double depth = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < kAlong; ++i)
    for (int j = 0; j < kAcross; ++j)
      for (int k = 0; k < kDeep; ++k) {
        const Eigen::Vector3d share(double(i) / (kAlong - 1), double(j) / (kAcross - 1),
                                    double(k) / (kDeep - 1));
        const Eigen::Vector3d q = box.min() + share.cwiseProduct(box.sizes());
        depth = std::max(depth, depth_in_solids(scene, frame.T_scene_gripper * q));
      }
  return depth;
}

double finger_depth(const Frame& frame, const Gripper& gripper, double half_opening,
                    const AnalyticScene& scene) {
  const double e = gripper.finger_thickness_m, w = gripper.finger_width_m, l = gripper.grasp_depth_m;
  const double back = l - gripper.finger_length_m;
  return std::max(
      box_depth(frame, scene,
                {Eigen::Vector3d(-e / 2, half_opening, back), Eigen::Vector3d(e / 2, half_opening + w, l)}),
      box_depth(
          frame, scene,
          {Eigen::Vector3d(-e / 2, -half_opening - w, back), Eigen::Vector3d(e / 2, -half_opening, l)}));
}

double hand_depth(const Frame& frame, const Gripper& gripper, const HandleCheckConfig& check,
                  const AnalyticScene& scene) {
  const double e = gripper.finger_thickness_m, half = 0.5 * gripper.aperture_m + gripper.finger_width_m;
  const double front = gripper.grasp_depth_m - gripper.finger_length_m;
  const double back = front - check.palm_depth_m - check.way_m;
  return box_depth(frame, scene, {Eigen::Vector3d(-e / 2, -half, back), Eigen::Vector3d(e / 2, half, front)});
}

}  // namespace

HandleTruth judge(const Handle& handle, const Gripper& gripper, const HandleCheckConfig& check,
                  const AnalyticScene& scene) {
  const Frame frame(handle);
  const double half = 0.5 * std::min<double>(gripper.aperture_m, handle.width_m + 2 * check.clearance_m);
  HandleTruth truth;
  Held best;
  for (std::size_t i = 1; i < scene.solids.size(); ++i) {
    const Held held = held_part(frame, gripper, half, scene.solids[i]);
    truth.num_between += held.lines > 0 ? 1 : 0;
    if (held.lines <= best.lines) continue;
    best = held;
    truth.solid = static_cast<int>(i);
  }
  truth.finger_depth_m = finger_depth(frame, gripper, half, scene);
  truth.hand_depth_m = hand_depth(frame, gripper, check, scene);
  if (truth.solid < 0) return truth;
  truth.width_m = best.high - best.low;
  truth.center_m = 0.5 * (best.high + best.low);
  truth.grip_depth_m = gripper.grasp_depth_m - best.top;
  truth.surface_m = std::abs(signed_distance(scene.solids[static_cast<std::size_t>(truth.solid)],
                                             frame.T_scene_gripper.translation()));
  return truth;
}

}  // namespace graspd

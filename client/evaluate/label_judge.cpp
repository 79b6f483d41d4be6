// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/label_judge.hpp"

#include <algorithm>
#include <map>

#include "client/evaluate/grip_shape.hpp"
#include "client/evaluate/hidden_space.hpp"

namespace graspd {
namespace {

constexpr int kTolerance = 4;  // stray points that a volume may have: noise does not scale with the cloud
constexpr std::size_t kMinTargetPoints = 15;
constexpr float kMinTargetShare = 0.90f;
constexpr float kMaxBelowSupport = 0.005f;
constexpr float kMinSeenArea = 1e-4f;
constexpr float kMinReach = 0.012f;   // of the object between the jaws
constexpr float kFreeFinger = 0.45f;  // share that may be hidden where a finger's place counts as seen
constexpr float kMaxHiddenByOthers = 0.3f;
constexpr float kMaxHidden = 0.5f;

/// What there is around a handle.
struct Surroundings {
  LocalPoints points;
  std::vector<int> object;  // of each
};

struct Counts {
  std::map<int, int> between;  // by object
  int own_in_fingers = 0, in_fingers = 0, in_palm = 0, in_way = 0;
};

Eigen::Vector3f at(const LocalPoints& points, std::size_t i) {
  return {points.a[i], points.f[i], points.z[i]};
}

Surroundings surroundings(const LabelScene& scene, const Handle& handle, const GripGeometry& geometry) {
  Surroundings result;
  const Eigen::Vector3f margin = Eigen::Vector3f::Constant(kShapeMargin);
  const LocalBox box = geometry.everything();
  scene.query().find(handle.position, handle.rotation, box.min - margin, box.max + margin, result.points);
  for (const std::uint32_t i : result.points.index) result.object.push_back(scene.object_of(i));
  return result;
}

/// The object that most points between the jaws belong to.
int main_object(const std::map<int, int>& between) {
  int object = kNoObject, most = 0;
  for (const auto& [id, count] : between) {
    if (id < 0 || count <= most) continue;
    object = id;
    most = count;
  }
  return object;
}

Counts count(const Surroundings& around, const GripGeometry& geometry) {
  Counts counts;
  const LocalBox between = geometry.between_jaws();
  for (std::size_t i = 0; i < around.object.size(); ++i)
    if (between.contains(at(around.points, i))) ++counts.between[around.object[i]];
  const int object = main_object(counts.between);
  const LocalBox left = geometry.finger(-1), right = geometry.finger(1), palm = geometry.palm_box();
  const std::array way{geometry.palm_way(), geometry.finger_way(-1), geometry.finger_way(1)};
  for (std::size_t i = 0; i < around.object.size(); ++i) {
    const Eigen::Vector3f p = at(around.points, i);
    if (left.contains(p) || right.contains(p)) {
      ++counts.in_fingers;
      counts.own_in_fingers += around.object[i] == object ? 1 : 0;
    }
    if (palm.contains(p)) ++counts.in_palm;
    if (std::any_of(way.begin(), way.end(), [&](const LocalBox& box) { return box.contains(p); }))
      ++counts.in_way;
  }
  return counts;
}

bool is_one_object(const std::map<int, int>& between, int object) {
  if (object == kNoObject) return false;
  std::size_t all = 0;
  for (const auto& [id, n] : between) all += static_cast<std::size_t>(n);
  const auto own = static_cast<std::size_t>(between.at(object));
  return own >= kMinTargetPoints && static_cast<float>(own) >= kMinTargetShare * static_cast<float>(all);
}

/// Whether every corner of the box keeps to its side of the support, but for what a fingertip may give.
bool above_support(const LabelScene& scene, const Handle& handle, const LocalBox& box) {
  if (!scene.support()) return true;
  const auto corners = box.corners();
  return std::all_of(corners.begin(), corners.end(), [&](const Eigen::Vector3f& corner) {
    return scene.support()->height(handle.position + handle.rotation * corner) >= -kMaxBelowSupport;
  });
}

GripShape make_shape(const LabelScene& scene, const Handle& handle, const GripGeometry& geometry,
                     const Surroundings& around, int object) {
  GripShape shape{geometry, {}, {}, {}, 0};
  const LocalBox between = geometry.between_jaws();
  LocalBox wider = between;
  wider.min.array() -= kShapeMargin;
  wider.max.array() += kShapeMargin;
  for (std::size_t i = 0; i < around.object.size(); ++i) {
    if (around.object[i] != object) continue;
    const Eigen::Vector3f p = at(around.points, i);
    if (between.contains(p)) shape.between.push_back(p);
    if (wider.contains(p)) shape.around.push_back(p);
  }
  shape.viewpoint = handle.rotation.transpose() * (scene.cloud().viewpoint - handle.position);
  shape.point_area_m2 = scene.depth_map().ray_area(handle.position);
  return shape;
}

/// How deep the object reaches between the jaws: from its top to the fingertips, or to the support below.
float reach(const LabelScene& scene, const Handle& handle, const GripShape& shape) {
  const float top = top_of(shape);
  float bottom = shape.geometry.tip();
  const auto& support = scene.support();
  if (support) {
    const float falling = -support->normal.dot(handle.rotation.col(2));
    if (falling > 0.1f) bottom = std::min(bottom, support->height(handle.position) / falling);
  }
  return bottom - top;
}

bool jaw_holds(const LabelScene& scene, const Handle& handle, int object, const GripShape& shape, int side,
               float finger_hidden) {
  const JawContact contact = find_contact(shape, side);
  if (contact.wall_seen) return true;
  if (contact.towards_viewpoint) return false;  // no wall where one would be seen
  if (is_occlusion_border(scene, handle, object, contact.border, side)) return false;
  return (finger_hidden <= kFreeFinger && !contact.is_wedge()) || contact.carried_on_clear;
}

bool jaws_hold(const LabelScene& scene, const Handle& handle, int object, const GripShape& shape,
               const std::array<HiddenShare, 2>& fingers) {
  if (seen_area(shape) < kMinSeenArea || reach(scene, handle, shape) < kMinReach) return false;
  return jaw_holds(scene, handle, object, shape, -1, fingers[0].all()) &&
         jaw_holds(scene, handle, object, shape, 1, fingers[1].all());
}

/// Whether the sensor saw enough of where the hand goes.
bool is_seen(const LabelScene& scene, const Handle& handle, const GripGeometry& geometry, int object,
             const std::array<HiddenShare, 2>& fingers) {
  if (fingers[0].by_others > kMaxHiddenByOthers || fingers[1].by_others > kMaxHiddenByOthers) return false;
  if (fingers[0].all() > kMaxHidden && fingers[1].all() > kMaxHidden) return false;
  const HiddenShare palm = hidden_share(scene, handle, geometry.palm_box(), object);
  return fingers[0].all() + fingers[1].all() + palm.all() <= 3 * kMaxHidden;
}

JudgeFailure first_failure(const LabelScene& scene, const Gripper& gripper, const Handle& handle,
                           Verdict& verdict) {
  const GripGeometry geometry(gripper, handle.width_m);
  const Surroundings around = surroundings(scene, handle, geometry);
  const Counts counts = count(around, geometry);
  verdict.object = main_object(counts.between);
  const std::array fingers{hidden_share(scene, handle, geometry.finger(-1), verdict.object),
                           hidden_share(scene, handle, geometry.finger(1), verdict.object)};
  verdict.hidden_share = {fingers[0].all(), fingers[1].all()};
  if (!is_one_object(counts.between, verdict.object)) return JudgeFailure::kTarget;
  if (handle.width_m > gripper.aperture_m || counts.own_in_fingers > kTolerance) return JudgeFailure::kFit;
  if (counts.in_fingers > kTolerance) return JudgeFailure::kFingers;
  if (counts.in_palm > kTolerance) return JudgeFailure::kPalm;
  if (!above_support(scene, handle, geometry.finger(-1)) || !above_support(scene, handle, geometry.finger(1)))
    return JudgeFailure::kSupport;
  const GripShape shape = make_shape(scene, handle, geometry, around, verdict.object);
  if (!sides_hold(shape)) return JudgeFailure::kSides;
  if (!walls_hold(shape)) return JudgeFailure::kWalls;
  if (!jaws_hold(scene, handle, verdict.object, shape, fingers)) return JudgeFailure::kContact;
  if (!is_seen(scene, handle, geometry, verdict.object, fingers)) return JudgeFailure::kUnseen;
  if (counts.in_way > kTolerance || !above_support(scene, handle, geometry.palm_box()) ||
      !above_support(scene, handle, geometry.palm_way()))
    return JudgeFailure::kWay;
  return JudgeFailure::kNone;
}

}  // namespace

std::string_view name(JudgeFailure failure) {
  constexpr std::array<std::string_view, 11> kNames{
      "target", "fit", "fingers", "palm", "support", "sides", "walls", "contact", "unseen", "way", ""};
  return kNames[static_cast<std::size_t>(failure)];
}

Verdict judge(const LabelScene& scene, const Gripper& gripper, const Handle& handle) {
  Verdict verdict;
  const bool finite = handle.position.allFinite() && handle.rotation.allFinite() && handle.width_m >= 0;
  if (finite && handle.position.norm() < 1e6f)
    verdict.failure = first_failure(scene, gripper, handle, verdict);
  return verdict;
}

}  // namespace graspd

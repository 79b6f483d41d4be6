// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Whether a handle holds on the true solids: the open hand comes in free, the jaws close on opposite walls of
// one object, and the contacts stay within the friction cone. Knows nothing of clouds.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "client/evaluate/solid_probe.hpp"
#include "service/pipeline/gripper.hpp"
#include "service/pipeline/handle.hpp"

namespace graspd {

/// Lengths in metres.
struct SolidJudgeConfig {
  double clearance_m = 0.004;    ///< open on each side of the handle's width, where the aperture allows
  double palm_depth_m = 0.020;   ///< of the palm behind the fingers
  double way_m = 0.100;          ///< how far back the hand comes from
  double penetration_m = 0.001;  ///< deeper than this into matter is a collision
  double friction = 0.5;         ///< coefficient: rubber pads on dry cardboard, plastic or metal, cautiously
  double pad_give_m = 0.0015;    ///< how far a soft pad yields: what is this near to first contact is touched
  double min_contact_m2 = 20e-6;  ///< on each side, touched within the friction cone: 4.5 mm by 4.5 mm
  double min_depth_m = 0.008;     ///< how far the object reaches between the jaws
  double max_off_center_m =
      0.005;                     ///< how far it is pushed before both jaws touch: the clearance and a little
  double pad_spacing_m = 0.002;  ///< between the spots of a pad at which contact is looked for
};

/// Why a handle does not hold, in the order of the checks.
enum class SolidFailure : std::uint8_t {
  kSupport,     ///< the hand would go into the support, on its way in or as the jaws close
  kFinger,      ///< an open finger would go into something else
  kPalm,        ///< the palm would
  kWay,         ///< the hand would, on its way in
  kNothing,     ///< nothing between the jaws
  kTwoObjects,  ///< the jaws meet different objects
  kFixed,       ///< they meet a wall of the bin
  kOffCenter,   ///< the object would be pushed far before the other jaw touches
  kShallow,     ///< too little of the object between the jaws
  kFriction,    ///< the contacts' normals are out of the friction cone
  kContact,     ///< too little of a pad touches within the friction cone
  kOpposite,    ///< no line through both contacts is within both cones
  kNone
};
inline constexpr std::size_t kNumSolidFailures = static_cast<std::size_t>(SolidFailure::kNone);

/// lower_snake, as in tables.
[[nodiscard]] std::string_view name(SolidFailure failure);

struct SolidVerdict {
  SolidFailure failure = SolidFailure::kNothing;
  std::size_t solid = kNoSolid;    ///< held, or met first by the jaws; index into the scene
  std::size_t blocker = kNoSolid;  ///< what the hand ran into
  double width_m = 0;              ///< between both contacts
  double off_center_m = 0;         ///< of the middle between them from the handle's, along the closing axis
  double depth_m = 0;              ///< how far the object reaches between the jaws
  std::array<double, 2> contact_deg{};  ///< of the mean normal from the closing axis, at -y and +y
  std::array<double, 2> contact_m2{};   ///< touched within the friction cone
  double line_deg = 0;  ///< of the best line through both contacts from the normal that is farther from it

  [[nodiscard]] bool holds() const { return failure == SolidFailure::kNone; }
  /// The reason with what it was measured by, one line.
  [[nodiscard]] std::string text(const Scene& scene) const;
};

/// Ready for many handles on one scene, which must outlive it.
class SolidJudge {
 public:
  SolidJudge(const Scene& scene, const Gripper& gripper, const SolidJudgeConfig& config = {});

  /// The handle in the scene's world frame.
  [[nodiscard]] SolidVerdict judge(const Handle& handle_world) const;

  [[nodiscard]] const SolidProbe& probe() const { return probe_; }
  [[nodiscard]] const Gripper& gripper() const { return gripper_; }
  [[nodiscard]] const SolidJudgeConfig& config() const { return config_; }

 private:
  SolidProbe probe_;
  Gripper gripper_;
  SolidJudgeConfig config_;
};

/// One handle, in the scene's world frame.
[[nodiscard]] SolidVerdict judge_on_solids(const Scene& scene, const Handle& handle_world,
                                           const Gripper& gripper, const SolidJudgeConfig& config = {});

}  // namespace graspd

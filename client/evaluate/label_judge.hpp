// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Whether a handle would hold one object, decided from labelled points, the sensor's view and the gripper's
// geometry. It shares no code with the checks of the pipeline, whose judge it is.
#pragma once
#include <array>
#include <cstdint>
#include <string_view>

#include "client/evaluate/label_scene.hpp"
#include "service/pipeline/gripper.hpp"
#include "service/pipeline/handle.hpp"

namespace graspd {

/// Why a handle does not hold, in the order of the tests.
enum class JudgeFailure : std::uint8_t {
  kTarget,   ///< what is between the jaws is not one object, or hardly anything
  kFit,      ///< the object is wider than the aperture, or than the handle says
  kFingers,  ///< a finger hits something
  kPalm,     ///< the palm does
  kSupport,  ///< a fingertip goes into the support
  kSides,    ///< the silhouettes run across the major axis: the jaws slip along them
  kWalls,    ///< the object widens towards the fingertips: the jaws slide off
  kContact,  ///< a jaw meets no wall of the object
  kUnseen,   ///< too much of the hand goes where the sensor did not look
  kWay,      ///< the hand hits something on its way in
  kNone
};

/// lower_snake.
[[nodiscard]] std::string_view name(JudgeFailure failure);

struct Verdict {
  JudgeFailure failure = JudgeFailure::kTarget;
  int object = kNoObject;               ///< most of what is between the jaws
  std::array<float, 2> hidden_share{};  ///< of each finger's volume, at -y and +y [0, 1]

  [[nodiscard]] bool valid() const { return failure == JudgeFailure::kNone; }
  [[nodiscard]] bool both_fingers_hidden() const { return hidden_share[0] > 0.5f && hidden_share[1] > 0.5f; }
};

/// The handle in the frame of the scene's cloud. A handle with numbers that are not finite holds nothing.
[[nodiscard]] Verdict judge(const LabelScene& scene, const Gripper& gripper, const Handle& handle);

}  // namespace graspd

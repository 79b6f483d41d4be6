// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Whether the gripper can take a candidate: fingers, palm and way in free, fingertips above the support, contact.
#pragma once
#include <array>
#include <cstdint>
#include <string_view>

namespace graspd {

/// Why a candidate is no handle, in the order of the checks.
enum class Failure : std::uint8_t {
  kTooFewPoints, kTooWide, kNoGap, kFingers, kPalm, kWay, kSupport, kSilhouettes, kWalls, kContact, kUnseen, kNone
};
inline constexpr std::size_t kNumFailures = static_cast<std::size_t>(Failure::kNone);
using FailureCounts = std::array<int, kNumFailures>;

/// lower_snake, as on the wire.
[[nodiscard]] std::string_view name(Failure failure);

}  // namespace graspd

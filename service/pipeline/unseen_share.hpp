// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// How much of where a hand goes the sensor did not see to be free.
#pragma once
#include <cstdint>

#include "service/pipeline/handle.hpp"
#include "service/pipeline/scene_view.hpp"

namespace graspd {

/// What counts as hidden.
enum class Hidden : std::uint8_t {
  kAtAll,    ///< whatever was not seen, beyond the borders of the image too
  kInView,   ///< by something
  kByOthers  ///< by something else than the object
};

/// A part of the hand in the gripper's frame, as thick as a finger: between two distances from the middle
/// along the closing axis, and between two depths [m].
struct HandBox {
  float from_f, to_f, from_z, to_z;
};

/// Share of the box at the handle that is hidden, of 72 places in it.
[[nodiscard]] float hidden_share(const SceneView& scene, const Handle& handle, float thickness_m,
                                 const HandBox& box, Hidden what, std::int32_t object);

}  // namespace graspd

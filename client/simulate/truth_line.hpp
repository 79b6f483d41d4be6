// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What a simulated camera really looked at, one line of JSON for each frame.
#pragma once
#include <cstdint>
#include <string>

#include "client/simulate/depth_camera.hpp"

namespace graspd {

/// {"seq": 3, "objects": [{"label": 20, "pixels": 5210, "points": [[x, y, z], ...]}, ...]}: every object with
/// a measured pixel, with its points of every fourth row and column, in the optical frame [m].
[[nodiscard]] std::string truth_line(std::int64_t seq, const DepthFrame& frame);

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Colours that people with any kind of colour vision can tell apart.
#pragma once
#include "client/draw/image.hpp"

namespace graspd {

inline constexpr Color kWhite{255, 255, 255};
inline constexpr Color kBlack{0, 0, 0};
inline constexpr Color kSupportColor{200, 200, 200};  ///< also of whatever else is in no segment
inline constexpr Color kEdgeColor{70, 70, 70};

/// One of six pale ones, in turn: Paul Tol's "light" scheme without its yellows, which are high scores.
[[nodiscard]] Color segment_color(int segment);

/// From dark blue (0) over grey to yellow (1): cividis, whose lightness grows evenly. Values outside are
/// those of the ends.
[[nodiscard]] Color score_color(double score);

/// From dark violet (0: near) to yellow (1: far): viridis.
[[nodiscard]] Color depth_color(double share);

}  // namespace graspd

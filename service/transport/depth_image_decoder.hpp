// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// depth_image_t -> Frame: an organized cloud in the optical frame, pixels without depth NaN.
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <variant>

#include "service/transport/frame.hpp"
#include "service/transport/refusal.hpp"

namespace graspd {

/// The message with its fingerprint, which the caller has looked at.
[[nodiscard]] std::variant<Frame, Refusal> decode_depth_image(std::span<const std::byte> message,
                                                              const DecodeLimits& limits);

/// What decoding would refuse, without the work of it.
[[nodiscard]] std::optional<Refusal> check_depth_image(std::span<const std::byte> message,
                                                       const DecodeLimits& limits);

}  // namespace graspd

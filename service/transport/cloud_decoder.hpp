// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Any message that clouds come in -> Frame, or the reason why not.
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <variant>

#include "service/transport/cloud_input.hpp"
#include "service/transport/frame.hpp"
#include "service/transport/refusal.hpp"

namespace graspd {

/// Tells the type by its fingerprint, ours and those of others that lcmtypes/README.md lists. Trusts nothing
/// in the bytes; throws nothing but std::bad_alloc, and allocates no more than the limits allow. A frame of
/// zero points is a frame.
[[nodiscard]] std::variant<Frame, Refusal> decode_cloud(std::span<const std::byte> message,
                                                        const DecodeLimits& limits,
                                                        const CloudInput& input = {});

/// What decode_cloud would refuse, without the work of it: microseconds for any size. What is wrong inside
/// compressed data only decoding can tell.
[[nodiscard]] std::optional<Refusal> check_cloud(std::span<const std::byte> message,
                                                 const DecodeLimits& limits, const CloudInput& input = {});

/// The header alone, for messages that are answered without being decoded; defaults from the first member
/// that cannot be read on.
[[nodiscard]] FrameHeader peek_header(std::span<const std::byte> message, const DecodeLimits& limits);

}  // namespace graspd

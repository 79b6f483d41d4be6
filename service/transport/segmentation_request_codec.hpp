// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// segmentation_request_t -> message, for clients, and back for the daemon.
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "graspd/segmentation_request_t.hpp"

namespace graspd {

/// A request holds at most this long [s].
inline constexpr double kLongestRequest_s = 60;

/// The message, fingerprint first. The second form reuses the buffer's memory.
[[nodiscard]] std::vector<std::byte> encode(const segmentation_request_t& request);
void encode(const segmentation_request_t& request, std::vector<std::byte>& buffer);

/// Nothing unless the message is a whole, valid segmentation_request_t for more than no and at most
/// kLongestRequest_s seconds. Trusts nothing in the bytes.
[[nodiscard]] std::optional<segmentation_request_t> decode_segmentation_request(
    std::span<const std::byte> message);

}  // namespace graspd

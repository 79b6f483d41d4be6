// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// status_t -> message, and back for clients.
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "graspd/status_t.hpp"

namespace graspd {

/// The message, fingerprint first. Throw std::invalid_argument when a num_ member is not the length of its
/// array. The second form reuses the buffer's memory.
[[nodiscard]] std::vector<std::byte> encode(const status_t& status);
void encode(const status_t& status, std::vector<std::byte>& buffer);

/// Nothing unless the message is a whole, valid status_t. Trusts nothing in the bytes.
[[nodiscard]] std::optional<status_t> decode_status(std::span<const std::byte> message);

}  // namespace graspd

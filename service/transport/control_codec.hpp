// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// control_t -> message, for clients, and back for the daemon.
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "graspd/control_t.hpp"

namespace graspd {

/// The message, fingerprint first. The second form reuses the buffer's memory.
[[nodiscard]] std::vector<std::byte> encode(const control_t& control);
void encode(const control_t& control, std::vector<std::byte>& buffer);

/// Nothing unless the message is a whole, valid control_t with a command that there is, an id above 0, and no
/// more text than kMaxOverridesLength. Trusts nothing in the bytes.
[[nodiscard]] std::optional<control_t> decode_control(std::span<const std::byte> message);

}  // namespace graspd

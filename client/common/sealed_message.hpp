// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Signed messages in logs, opened with a key.
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "service/transport/seal.hpp"

namespace graspd {

/// What a sealed_t of this channel holds, where one of the keys opens it; any other message as it is. How old
/// it is does not count.
[[nodiscard]] std::span<const std::byte> opened(std::span<const SealKey> keys, std::string_view channel,
                                                std::span<const std::byte> message);

/// Of a file; none without a name. Throws as load_seal_keys() does.
[[nodiscard]] std::vector<SealKey> seal_keys_of(const std::string& file);

}  // namespace graspd

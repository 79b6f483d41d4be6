// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The labels in a point_cloud_t: the service's decoder leaves them out, because the method never sees them.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace graspd {

/// One label a point from the field `label` (UINT8, UINT16 or UINT32); empty when the message has none, or is
/// no whole point_cloud_t. Trusts nothing in the bytes.
[[nodiscard]] std::vector<std::uint32_t> decode_labels(std::span<const std::byte> message);

}  // namespace graspd

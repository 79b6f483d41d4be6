// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The colours of a cloud, which never reach the pipeline.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "service/transport/refusal.hpp"

namespace graspd {

/// 0x00RRGGBB, one a point in the message's order, where it is a point_cloud_t with a UINT32 or FLOAT32 field
/// "rgb"; empty where there is none, and for every other message. Trusts nothing in the bytes.
[[nodiscard]] std::vector<std::uint32_t> cloud_colors(std::span<const std::byte> message,
                                                      const DecodeLimits& limits);

}  // namespace graspd

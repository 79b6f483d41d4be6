// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Bounded reading of what several answers hold.
#pragma once
#include <cstdint>
#include <vector>

#include "graspd/reason_count_t.hpp"
#include "service/transport/byte_reader.hpp"

namespace graspd {

/// Longest string of an answer [characters].
inline constexpr std::int32_t kMaxTextLength = 4096;

/// Longest text of a control message, and of the overrides that come of it [characters].
inline constexpr std::int32_t kMaxOverridesLength = 16'383;

/// Fewest bytes of a reason_count_t.
inline constexpr std::size_t kMinReasonBytes = 4 + 1 + 8;

/// An array with its count before it; returns the count.
inline std::int32_t read_reason_counts(ByteReader& reader, std::vector<reason_count_t>& entries) {
  constexpr std::int32_t kMaxReasons = 1000;
  const std::int32_t count = reader.count("num_reasons", kMaxReasons, kMinReasonBytes);
  entries.resize(static_cast<std::size_t>(count));
  for (reason_count_t& entry : entries) {
    entry.reason = reader.string("reason", kMaxTextLength);
    entry.count = reader.int64("count");
  }
  return count;
}

}  // namespace graspd

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

/// An array with its count before it; returns the count.
inline std::int32_t read_reason_counts(ByteReader& reader, std::vector<reason_count_t>& entries) {
  constexpr std::int32_t kMaxReasons = 1000;
  constexpr std::size_t kMinBytes = 4 + 1 + 8;
  const std::int32_t count = reader.count("num_reasons", kMaxReasons, kMinBytes);
  entries.resize(static_cast<std::size_t>(count));
  for (reason_count_t& entry : entries) {
    entry.reason = reader.string("reason", kMaxTextLength);
    entry.count = reader.int64("count");
  }
  return count;
}

}  // namespace graspd

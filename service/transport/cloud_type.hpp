// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// One type that clouds come in: how it is told, and what is done with it.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <variant>

#include "service/transport/byte_reader.hpp"
#include "service/transport/cloud_input.hpp"
#include "service/transport/frame.hpp"
#include "service/transport/refusal.hpp"

namespace graspd {

/// Messages are whole, with the fingerprint, which the caller has looked at.
struct CloudType {
  std::uint64_t fingerprint = 0;
  std::string_view name;
  /// The header alone, from where the reader stands after the fingerprint.
  FrameHeader (*read_header)(ByteReader& reader, const DecodeLimits& limits) = nullptr;
  /// What decoding would refuse, as far as that can be told without the work of it.
  std::optional<Refusal> (*check)(std::span<const std::byte> message, const DecodeLimits& limits,
                                  const CloudInput& input) = nullptr;
  std::variant<Frame, Refusal> (*decode)(std::span<const std::byte> message, const DecodeLimits& limits,
                                         const CloudInput& input) = nullptr;
};

}  // namespace graspd

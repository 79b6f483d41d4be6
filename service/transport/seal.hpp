// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Signs messages and checks signatures: sealed_t around another message. Pure functions.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "service/transport/refusal.hpp"

namespace graspd {

inline constexpr std::size_t kSealKeyBytes = 32;
inline constexpr std::size_t kMacBytes = 32;
/// What a seal adds to a message.
inline constexpr std::size_t kSealBytes = 8 + 4 * 8 + 4 + kMacBytes;

/// A secret that senders and receivers share.
struct SealKey {
  std::array<unsigned char, kSealKeyBytes> bytes{};

  /// As in sealed_t.key_id; tells nothing about the key.
  [[nodiscard]] std::int64_t id() const;
};

/// Tells one message from all others of a key.
struct SealHeader {
  std::int64_t sender = 0;
  std::int64_t seq = 0;
  std::int64_t utime = 0;  ///< [us] since 1970
};

/// Writes the sealed_t for this channel into the buffer. The message may have up to 2^31 - 1 bytes, else
/// std::invalid_argument.
void seal(const SealKey& key, const SealHeader& header, std::string_view channel,
          std::span<const std::byte> message, std::vector<std::byte>& sealed);

/// A message whose seal is right: made with the key, for the channel, and unchanged.
struct Unsealed {
  SealHeader header;
  std::span<const std::byte> message;  ///< inside what was unsealed
};

/// Refuses what is no sealed_t (kUnsigned), has not its length, or carries a MAC that no key gives (kForged).
/// Old messages are right here for ever: see SealVerifier.
[[nodiscard]] std::variant<Unsealed, Refusal> unseal(std::span<const SealKey> keys, std::string_view channel,
                                                     std::span<const std::byte> sealed);

}  // namespace graspd

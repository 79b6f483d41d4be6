// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What a program seals its messages with.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "service/transport/seal.hpp"

namespace graspd {

/// One sender: counts its messages. Not for several threads at once.
class Sealer {
 public:
  /// Draws the sender's number.
  explicit Sealer(const SealKey& key);

  /// The sealed message, until the next call. now_utime: the wall clock [us] since 1970.
  [[nodiscard]] std::span<const std::byte> seal(std::string_view channel, std::span<const std::byte> message,
                                                std::int64_t now_utime);

 private:
  const SealKey key_;
  const std::int64_t sender_;
  std::int64_t seq_ = 0;
  std::vector<std::byte> buffer_;
};

}  // namespace graspd

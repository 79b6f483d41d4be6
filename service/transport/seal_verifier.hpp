// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Opens sealed messages, each once and in its time.
#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "service/transport/refusal.hpp"
#include "service/transport/seal.hpp"

namespace graspd {

/// Holds a sender's latest 64 sequence numbers, so that messages may overtake each other a little, and at
/// most kMaxSenders senders; one that is forgotten cannot be replayed either. Not for several threads at
/// once.
class SealVerifier {
 public:
  static constexpr std::size_t kMaxSenders = 256;

  SealVerifier() = default;
  SealVerifier(std::vector<SealKey> keys, std::int64_t max_age_us);

  /// max_age_us: how far a message's time may be from ours, either way. What has come before stays known.
  void configure(std::vector<SealKey> keys, std::int64_t max_age_us);
  [[nodiscard]] const std::vector<SealKey>& keys() const { return keys_; }

  /// The message inside, or why not: kUnsigned, kTruncated, kTrailingBytes, kForged, kStale, kReplayed.
  /// now_utime: the wall clock [us] since 1970.
  [[nodiscard]] std::variant<std::span<const std::byte>, Refusal> open(std::string_view channel,
                                                                       std::span<const std::byte> sealed,
                                                                       std::int64_t now_utime);

 private:
  struct Sender {
    std::int64_t newest_seq = 0;
    std::uint64_t seen = 0;  ///< bit i: newest_seq - i has come
    std::int64_t newest_utime = 0;
  };

  [[nodiscard]] Sender* find_or_add(const SealHeader& header);
  void forget_oldest();

  std::vector<SealKey> keys_;
  std::int64_t max_age_us_ = 0;
  std::map<std::int64_t, Sender> senders_;
  std::int64_t forgotten_utime_ =
      std::numeric_limits<std::int64_t>::min();  // no forgotten sender has sent anything later
};

}  // namespace graspd

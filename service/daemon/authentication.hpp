// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Who may speak: with a key file in the configuration, only who has a key.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "service/config/service_config.hpp"
#include "service/transport/lcm_bus.hpp"
#include "service/transport/seal_verifier.hpp"

namespace graspd {

/// Belongs to the LCM thread. Takes every message as long as there is no key.
class Authentication {
 public:
  /// The keys of the configured file, none where none is configured; throws std::runtime_error as
  /// load_seal_keys.
  [[nodiscard]] static std::vector<SealKey> load_keys(const ServiceConfig& config);

  /// From now on these hold. What has come before stays known: a reload lets nothing be replayed.
  void configure(const ServiceConfig& config, std::vector<SealKey> keys);

  /// The message as it came, or with keys the one inside its seal; else why it is refused. Each packet may be
  /// opened once. now_utime: the wall clock [us] since 1970.
  [[nodiscard]] std::variant<std::span<const std::byte>, Refusal> open(const Packet& packet,
                                                                       std::int64_t now_utime);

  /// Whether a channel that nothing is known of may be served because of this packet: strangers must not use
  /// up the number of sources.
  [[nodiscard]] bool admits(const Packet& packet) const;

 private:
  [[nodiscard]] bool too_large(const Packet& packet) const;

  std::size_t max_bytes_ = 0;
  SealVerifier verifier_;
};

}  // namespace graspd

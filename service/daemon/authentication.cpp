// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/daemon/authentication.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "service/transport/seal_keys.hpp"

namespace graspd {

std::vector<SealKey> Authentication::load_keys(const ServiceConfig& config) {
  const std::string& file = config.authentication.key_file;
  return file.empty() ? std::vector<SealKey>() : load_seal_keys(file);
}

void Authentication::configure(const ServiceConfig& config, std::vector<SealKey> keys) {
  max_bytes_ = static_cast<std::size_t>(config.limits.decode.max_message_bytes) + kSealBytes;
  verifier_.configure(std::move(keys),
                      std::llround(1e6 * static_cast<double>(config.authentication.max_age_s)));
}

std::variant<std::span<const std::byte>, Refusal> Authentication::open(const Packet& packet,
                                                                       std::int64_t now_utime) {
  if (verifier_.keys().empty()) return packet.bytes;
  // Before it costs anything.
  if (too_large(packet))
    return Refusal{RefusalReason::kTooLarge,
                   "message: too large (got " + std::to_string(packet.bytes.size()) + " bytes)",
                   0,
                   -1,
                   {}};
  return verifier_.open(packet.channel, packet.bytes, now_utime);
}

bool Authentication::admits(const Packet& packet) const {
  if (verifier_.keys().empty()) return true;
  return !too_large(packet) &&
         std::holds_alternative<Unsealed>(unseal(verifier_.keys(), packet.channel, packet.bytes));
}

bool Authentication::too_large(const Packet& packet) const {
  return packet.bytes.size() > max_bytes_;
}

}  // namespace graspd

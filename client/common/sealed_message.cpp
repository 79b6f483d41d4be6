// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/common/sealed_message.hpp"

#include <variant>

#include "service/transport/seal_keys.hpp"

namespace graspd {

std::span<const std::byte> opened(std::span<const SealKey> keys, std::string_view channel,
                                  std::span<const std::byte> message) {
  if (keys.empty()) return message;
  const auto inside = unseal(keys, channel, message);
  const auto* found = std::get_if<Unsealed>(&inside);
  return found != nullptr ? found->message : message;
}

std::vector<SealKey> seal_keys_of(const std::string& file) {
  return file.empty() ? std::vector<SealKey>() : load_seal_keys(file);
}

}  // namespace graspd

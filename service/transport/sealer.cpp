// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/sealer.hpp"

#include <sodium.h>

#include <stdexcept>

namespace graspd {
namespace {

std::int64_t random_number() {
  if (sodium_init() < 0) throw std::runtime_error("libsodium finds no source of random numbers");
  std::int64_t number = 0;
  randombytes_buf(&number, sizeof(number));
  return number;
}

}  // namespace

Sealer::Sealer(const SealKey& key) : key_(key), sender_(random_number()) {}

std::span<const std::byte> Sealer::seal(std::string_view channel, std::span<const std::byte> message,
                                        std::int64_t now_utime) {
  graspd::seal(key_, {sender_, ++seq_, now_utime}, channel, message, buffer_);
  return buffer_;
}

}  // namespace graspd

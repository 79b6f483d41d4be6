// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What the fuzzers share: fuzzed bytes become the body behind a right fingerprint, else they would never get
// past it.
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace graspd {

inline std::vector<std::byte> message_of(std::uint64_t fingerprint, const std::uint8_t* body,
                                         std::size_t size) {
  std::vector<std::byte> message;
  message.reserve(8 + size);
  for (int shift = 56; shift >= 0; shift -= 8)
    message.push_back(static_cast<std::byte>((fingerprint >> shift) & 0xff));
  for (const std::uint8_t byte : std::span(body, size)) message.push_back(static_cast<std::byte>(byte));
  return message;
}

/// In every build, unlike assert.
inline void require(bool condition) {
  if (!condition) std::abort();
}

}  // namespace graspd

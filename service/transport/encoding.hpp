// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What the encoders share around lcm-gen's code.
#pragma once
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace graspd {

/// lcm-gen's encoder trusts a num_ member and reads that far into the vector.
inline void require_count(const char* member, std::int32_t count, std::size_t length) {
  if (count >= 0 && static_cast<std::size_t>(count) == length) return;
  throw std::invalid_argument(std::string(member) + " is " + std::to_string(count) + ", its array has " +
                              std::to_string(length) + " elements");
}

template <class Message>
void encode_message(const Message& message, std::vector<std::byte>& buffer) {
  const int size = message.getEncodedSize();
  buffer.resize(static_cast<std::size_t>(size));
  const int written = message.encode(buffer.data(), 0, size);
  if (written < 0) throw std::logic_error("an LCM message does not fit its own encoded size");
  buffer.resize(static_cast<std::size_t>(written));  // less where a string has a NUL inside: it ends there
}

template <class Message>
std::vector<std::byte> encoded(const Message& message) {
  std::vector<std::byte> buffer;
  encode(message, buffer);
  return buffer;
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Writes LCM's big-endian encoding.
#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory_resource>
#include <span>
#include <string_view>
#include <vector>

namespace graspd {

/// Appends to a buffer, whose memory the next message can use again.
class ByteWriter {
 public:
  explicit ByteWriter(std::pmr::vector<std::byte>& bytes) : bytes_(bytes) {}

  void int8(std::int8_t value) { integer(static_cast<std::uint8_t>(value)); }
  void int32(std::int32_t value) { integer(static_cast<std::uint32_t>(value)); }
  void int64(std::int64_t value) { integer(static_cast<std::uint64_t>(value)); }
  void uint64(std::uint64_t value) { integer(value); }
  void float64(double value) { integer(std::bit_cast<std::uint64_t>(value)); }
  /// Each as a double.
  void float64s(std::span<const float> values) {
    for (const float value : values) float64(double{value});
  }
  /// Ends at a NUL inside, as lcm-gen's strings do.
  void string(std::string_view text) {
    text = text.substr(0, text.find('\0'));
    int32(static_cast<std::int32_t>(text.size() + 1));
    const auto* begin = reinterpret_cast<const std::byte*>(text.data());
    bytes_.insert(bytes_.end(), begin, begin + text.size());
    bytes_.push_back({});
  }
  /// Of the elements that follow.
  void count(std::size_t value) { int32(static_cast<std::int32_t>(value)); }

  /// Where the next value goes.
  [[nodiscard]] std::size_t size() const { return bytes_.size(); }

 private:
  template <class Unsigned>
  void integer(Unsigned value) {
    std::byte bytes[sizeof(Unsigned)];
    for (std::size_t i = sizeof(Unsigned); i-- > 0; value = static_cast<Unsigned>(value >> 8))
      bytes[i] = static_cast<std::byte>(value);
    bytes_.insert(bytes_.end(), std::begin(bytes), std::end(bytes));
  }

  std::pmr::vector<std::byte>& bytes_;
};

}  // namespace graspd

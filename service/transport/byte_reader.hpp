// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Reads LCM's big-endian encoding from bytes that nobody has checked.
#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>

namespace graspd {

/// Never reads beyond its bytes and never allocates. The first failure sticks: from then on every read gives
/// zero or an empty view, so that callers check once, after a run of reads. The first argument of each read
/// names the member for the failure's text and must outlive the reader (a literal).
class ByteReader {
 public:
  enum class Failure : std::uint8_t {
    kNone,
    kTruncated,      ///< the bytes end before the value does
    kBadLength,      ///< a string's length or an array's count that cannot be
    kBadString,      ///< a string without its final NUL, or with another inside, or not text
    kTrailingBytes,  ///< from finish(): the message ends before the bytes do
  };

  explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  std::int8_t int8(const char* place) { return static_cast<std::int8_t>(integer<std::uint8_t>(place)); }
  std::int16_t int16(const char* place) { return static_cast<std::int16_t>(integer<std::uint16_t>(place)); }
  std::int32_t int32(const char* place) { return static_cast<std::int32_t>(integer<std::uint32_t>(place)); }
  std::int64_t int64(const char* place) { return static_cast<std::int64_t>(integer<std::uint64_t>(place)); }
  double float64(const char* place) { return std::bit_cast<double>(integer<std::uint64_t>(place)); }
  void float64s(const char* place, std::span<double> values);

  /// A view into the bytes, without the final NUL; fails on more than max_length characters.
  std::string_view string(const char* place, std::int32_t max_length);

  /// The same for text that ends up in logs and answers: fails on control characters, too.
  std::string_view text(const char* place, std::int32_t max_length);

  /// The number of elements of an array that takes at least min_element_bytes each; fails when it is
  /// negative, more than max_count, or more than the bytes that are left can hold. What succeeds is safe to
  /// allocate for.
  std::int32_t count(const char* place, std::int32_t max_count, std::size_t min_element_bytes);
  /// The same for counts that take two and eight bytes, of single bytes.
  std::size_t byte_count16(const char* place);
  std::size_t byte_count64(const char* place);

  /// A view of the next bytes.
  std::span<const std::byte> bytes(const char* place, std::size_t size);
  void skip(const char* place, std::size_t size) { (void)bytes(place, size); }

  /// Fails when bytes are left.
  void finish();

  [[nodiscard]] bool ok() const { return failure_ == Failure::kNone; }
  [[nodiscard]] Failure failure() const { return failure_; }
  /// Where the next read starts; after a failure, where the value that failed starts.
  [[nodiscard]] std::size_t offset() const { return offset_; }
  [[nodiscard]] std::size_t remaining() const { return bytes_.size() - offset_; }
  /// One line for people: member, byte, value, what was expected. Empty while ok().
  [[nodiscard]] std::string failure_text() const;

 private:
  template <class Unsigned>
  Unsigned integer(const char* place) {
    const auto view = bytes(place, sizeof(Unsigned));
    Unsigned value = 0;
    for (const std::byte b : view) value = static_cast<Unsigned>((value << 8) | static_cast<Unsigned>(b));
    return value;
  }
  std::int64_t checked_count(const char* place, std::size_t start, std::int64_t value, std::int64_t max_count,
                             std::size_t min_element_bytes);
  void fail(Failure failure, const char* place, std::int64_t got, std::int64_t expected);

  std::span<const std::byte> bytes_;
  std::size_t offset_ = 0;
  Failure failure_ = Failure::kNone;
  const char* place_ = "";
  std::int64_t got_ = 0;
  std::int64_t expected_ = 0;
};

}  // namespace graspd

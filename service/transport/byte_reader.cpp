// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/byte_reader.hpp"

#include <cstring>

namespace graspd {

void ByteReader::fail(Failure failure, const char* place, std::int64_t got, std::int64_t expected) {
  if (!ok()) return;
  failure_ = failure;
  place_ = place;
  got_ = got;
  expected_ = expected;
}

std::span<const std::byte> ByteReader::bytes(const char* place, std::size_t size) {
  if (!ok()) return {};
  if (size > remaining()) {
    fail(Failure::kTruncated, place, static_cast<std::int64_t>(remaining()), static_cast<std::int64_t>(size));
    return {};
  }
  const auto view = bytes_.subspan(offset_, size);
  offset_ += size;
  return view;
}

void ByteReader::float64s(const char* place, std::span<double> values) {
  for (double& value : values) value = float64(place);
}

std::string_view ByteReader::string(const char* place, std::int32_t max_length) {
  const std::size_t start = offset_;
  const std::int32_t size = int32(place);  // counts the final NUL
  if (!ok()) return {};
  if (size < 1 || size - 1 > max_length) {
    offset_ = start;
    fail(Failure::kBadLength, place, size, std::int64_t{max_length} + 1);
    return {};
  }
  const auto view = bytes(place, static_cast<std::size_t>(size));
  if (!ok()) return {};
  const auto* text = reinterpret_cast<const char*>(view.data());
  const std::size_t length = view.size() - 1;
  const void* nul = std::memchr(text, 0, view.size());
  if (nul != text + length) {
    offset_ = start;
    fail(Failure::kBadString, place, 0, 0);
    return {};
  }
  return {text, length};
}

std::string_view ByteReader::text(const char* place, std::int32_t max_length) {
  const std::size_t start = offset_;
  const std::string_view value = string(place, max_length);
  for (const char c : value) {
    const auto code = static_cast<unsigned char>(c);
    if (code >= 0x20 && code != 0x7f) continue;
    offset_ = start;
    fail(Failure::kBadString, place, code, 0);
    return {};
  }
  return value;
}

std::int64_t ByteReader::checked_count(const char* place, std::size_t start, std::int64_t value,
                                       std::int64_t max_count, std::size_t min_element_bytes) {
  if (!ok()) return 0;
  if (value < 0 || value > max_count) {
    offset_ = start;
    fail(Failure::kBadLength, place, value, max_count);
    return 0;
  }
  // By division: the product of a count of eight bytes may not be a number.
  if (static_cast<std::size_t>(value) > remaining() / min_element_bytes) {
    fail(Failure::kTruncated, place, static_cast<std::int64_t>(remaining() / min_element_bytes), value);
    return 0;
  }
  return value;
}

std::int32_t ByteReader::count(const char* place, std::int32_t max_count, std::size_t min_element_bytes) {
  const std::size_t start = offset_;
  const std::int32_t value = int32(place);
  return static_cast<std::int32_t>(checked_count(place, start, value, max_count, min_element_bytes));
}

std::size_t ByteReader::byte_count16(const char* place) {
  const std::size_t start = offset_;
  const std::int16_t value = int16(place);
  return static_cast<std::size_t>(
      checked_count(place, start, value, std::numeric_limits<std::int16_t>::max(), 1));
}

std::size_t ByteReader::byte_count64(const char* place) {
  const std::size_t start = offset_;
  const std::int64_t value = int64(place);
  return static_cast<std::size_t>(
      checked_count(place, start, value, std::numeric_limits<std::int64_t>::max(), 1));
}

void ByteReader::finish() {
  if (ok() && remaining() > 0) {
    fail(Failure::kTrailingBytes, "end", static_cast<std::int64_t>(remaining()), 0);
  }
}

std::string ByteReader::failure_text() const {
  const std::string at = std::string(place_) + " at byte " + std::to_string(offset_) + ": ";
  const std::string got = std::to_string(got_);
  const std::string expected = std::to_string(expected_);
  switch (failure_) {
    case Failure::kNone:
      return {};
    case Failure::kTruncated:
      return at + "the message ends (got " + got + " bytes, expected " + expected + ")";
    case Failure::kBadLength:
      return at + "impossible length (got " + got + ", expected at most " + expected + ")";
    case Failure::kBadString:
      return at + "character " + got + " inside or no NUL at the end (expected text)";
    case Failure::kTrailingBytes:
      return at + "the message goes on (got " + got + " more bytes, expected none)";
  }
  return {};
}

}  // namespace graspd

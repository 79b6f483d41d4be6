// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/byte_reader.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/transport/message_samples.hpp"

namespace graspd {
namespace {

Bytes big_endian(std::int64_t value, std::size_t size) {
  Bytes bytes(size);
  put(bytes, 0, value, size);
  return bytes;
}

/// A string as it is on the wire, of a length that need not be true.
Bytes wire_string(std::int32_t length, const std::string& characters) {
  Bytes bytes = big_endian(length, 4);
  for (const char c : characters) bytes.push_back(static_cast<std::byte>(c));
  return bytes;
}

TEST(ByteReader, ReadsBigEndianNumbers) {
  for (const std::int64_t value : {std::int64_t{0}, std::int64_t{-1}, std::int64_t{0x0102030405060708},
                                   std::numeric_limits<std::int64_t>::min()}) {
    EXPECT_EQ(ByteReader(big_endian(value, 8)).int64("v"), value);
    EXPECT_EQ(ByteReader(big_endian(value, 4)).int32("v"), static_cast<std::int32_t>(value));
    EXPECT_EQ(ByteReader(big_endian(value, 1)).int8("v"), static_cast<std::int8_t>(value));
    EXPECT_EQ(std::bit_cast<std::int64_t>(ByteReader(big_endian(value, 8)).float64("v")), value);
  }
}

TEST(ByteReader, EmptyBytesFailEveryRead) {
  const auto fails = [](auto read) {
    ByteReader reader{{}};
    read(reader);
    return reader.failure() == ByteReader::Failure::kTruncated && reader.offset() == 0;
  };
  EXPECT_TRUE(fails([](ByteReader& r) { EXPECT_EQ(r.int8("v"), 0); }));
  EXPECT_TRUE(fails([](ByteReader& r) { EXPECT_EQ(r.int32("v"), 0); }));
  EXPECT_TRUE(fails([](ByteReader& r) { EXPECT_EQ(r.int64("v"), 0); }));
  EXPECT_TRUE(fails([](ByteReader& r) { EXPECT_EQ(r.float64("v"), 0); }));
  EXPECT_TRUE(fails([](ByteReader& r) { EXPECT_TRUE(r.string("v", 10).empty()); }));
  EXPECT_TRUE(fails([](ByteReader& r) { EXPECT_EQ(r.count("v", 10, 1), 0); }));
  EXPECT_TRUE(fails([](ByteReader& r) { EXPECT_TRUE(r.bytes("v", 1).empty()); }));
  EXPECT_TRUE(fails([](ByteReader& r) { r.skip("v", std::numeric_limits<std::size_t>::max()); }));
  ByteReader nothing{{}};
  EXPECT_TRUE(nothing.bytes("v", 0).empty());
  nothing.finish();
  EXPECT_TRUE(nothing.ok());
}

TEST(ByteReader, FirstFailureSticks) {
  Bytes bytes = big_endian(5, 4);
  bytes.resize(6);
  ByteReader reader(bytes);
  EXPECT_EQ(reader.int32("first"), 5);
  EXPECT_EQ(reader.int64("second"), 0);
  const std::string text = reader.failure_text();
  EXPECT_EQ(text, "second at byte 4: the message ends (got 2 bytes, expected 8)");
  EXPECT_EQ(reader.int8("third"), 0);  // there is a byte, and it is not read any more
  EXPECT_TRUE(reader.string("fourth", 9).empty());
  reader.finish();
  EXPECT_EQ(reader.failure_text(), text);
  EXPECT_EQ(reader.offset(), 4u);
}

TEST(ByteReader, StringIsAViewWithoutItsNul) {
  const Bytes bytes = wire_string(4, std::string("abc\0", 4));
  ByteReader reader(bytes);
  EXPECT_EQ(reader.string("s", 3), "abc");
  reader.finish();
  EXPECT_TRUE(reader.ok());
  const Bytes empty = wire_string(1, std::string(1, '\0'));
  ByteReader empty_reader(empty);
  EXPECT_EQ(empty_reader.string("s", 3), "");
  EXPECT_TRUE(empty_reader.ok());
}

TEST(ByteReader, LyingStringsFail) {
  const auto failure = [](std::int32_t length, const std::string& characters) {
    const Bytes bytes = wire_string(length, characters);
    ByteReader reader(bytes);
    EXPECT_TRUE(reader.string("s", 3).empty());
    return reader.failure();
  };
  constexpr std::int32_t kMin = std::numeric_limits<std::int32_t>::min();
  constexpr std::int32_t kMax = std::numeric_limits<std::int32_t>::max();
  for (const std::int32_t length : {kMin, -1, 0, 5, kMax}) {
    EXPECT_EQ(failure(length, std::string("abc\0", 4)), ByteReader::Failure::kBadLength) << length;
  }
  EXPECT_EQ(failure(4, "abc"), ByteReader::Failure::kTruncated);
  EXPECT_EQ(failure(4, "abcd"), ByteReader::Failure::kBadString);
  EXPECT_EQ(failure(4, std::string("a\0c\0", 4)), ByteReader::Failure::kBadString);
}

TEST(ByteReader, TextHasNoControlCharacters) {
  for (int c = 1; c < 256; ++c) {
    const Bytes bytes = wire_string(2, std::string(1, static_cast<char>(c)) + '\0');
    ByteReader reader(bytes);
    (void)reader.text("s", 1);
    EXPECT_EQ(reader.ok(), c >= 0x20 && c != 0x7f) << c;
  }
}

TEST(ByteReader, CountIsBoundedByLimitAndByBytes) {
  const auto count_of = [](std::int32_t value, std::int32_t max, std::size_t element,
                           std::size_t bytes_left) {
    Bytes bytes = big_endian(value, 4);
    bytes.resize(4 + bytes_left);
    ByteReader reader(bytes);
    const std::int32_t count = reader.count("n", max, element);
    EXPECT_TRUE(reader.ok() || count == 0);
    return std::pair(reader.failure(), count);
  };
  using Failure = ByteReader::Failure;
  EXPECT_EQ(count_of(3, 3, 2, 6), std::pair(Failure::kNone, 3));
  EXPECT_EQ(count_of(0, 3, 2, 0), std::pair(Failure::kNone, 0));
  EXPECT_EQ(count_of(3, 3, 2, 5).first, Failure::kTruncated);
  EXPECT_EQ(count_of(4, 3, 2, 100).first, Failure::kBadLength);
  EXPECT_EQ(count_of(-1, 3, 2, 100).first, Failure::kBadLength);
  EXPECT_EQ(count_of(std::numeric_limits<std::int32_t>::min(), 3, 0, 0).first, Failure::kBadLength);
  constexpr std::int32_t kMax = std::numeric_limits<std::int32_t>::max();
  EXPECT_EQ(count_of(kMax, kMax, 1000, 100).first, Failure::kTruncated);
}

TEST(ByteReader, FinishFindsTrailingBytes) {
  const Bytes bytes(3);
  ByteReader reader(bytes);
  reader.skip("two", 2);
  reader.finish();
  EXPECT_EQ(reader.failure(), ByteReader::Failure::kTrailingBytes);
  EXPECT_EQ(reader.failure_text(), "end at byte 2: the message goes on (got 1 more bytes, expected none)");
}

}  // namespace
}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/decoding.hpp"

#include <algorithm>
#include <array>
#include <charconv>

namespace graspd {
namespace {

RefusalReason reason_of(ByteReader::Failure failure) {
  switch (failure) {
    case ByteReader::Failure::kBadLength:
      return RefusalReason::kBadSize;
    case ByteReader::Failure::kBadString:
      return RefusalReason::kBadString;
    case ByteReader::Failure::kTrailingBytes:
      return RefusalReason::kTrailingBytes;
    default:
      return RefusalReason::kTruncated;
  }
}

std::string product_text(const DataLayout& layout) {
  return std::to_string(layout.width) + " * " + std::to_string(layout.height);
}

}  // namespace

FrameHeader read_header(ByteReader& reader, const DecodeLimits& limits) {
  FrameHeader header;
  const std::int64_t utime = reader.int64("utime");
  if (reader.ok()) header.utime = utime;
  const std::int64_t seq = reader.int64("seq");
  if (reader.ok()) header.seq = seq;
  header.frame_name = reader.text("frame_name", limits.max_name_length);
  return header;
}

Refusal refuse(RefusalReason reason, std::string_view place, const std::string& what,
               const FrameHeader& header) {
  return {reason, std::string(place) + ": " + what, header.utime, header.seq, header.frame_name};
}

Refusal refuse(const ByteReader& reader, std::string_view type, const FrameHeader& header) {
  return {reason_of(reader.failure()), std::string(type) + "." + reader.failure_text(), header.utime,
          header.seq, header.frame_name};
}

std::optional<Refusal> check_layout(const DataLayout& layout, const DecodeLimits& limits,
                                    const FrameHeader& header) {
  const std::string type(layout.type);
  if (layout.width < 0 || layout.height < 0) {
    return refuse(RefusalReason::kBadSize, type + ".width, height",
                  "negative (got " + product_text(layout) + ", expected at least 0)", header);
  }
  const std::int64_t elements = std::int64_t{layout.width} * layout.height;
  if (elements > limits.max_points) {
    return refuse(RefusalReason::kTooLarge, type + ".width * height",
                  "too many points (got " + product_text(layout) + ", expected at most " +
                      std::to_string(limits.max_points) + ")",
                  header);
  }
  const std::int64_t expected = elements * layout.element_bytes;
  if (layout.data_size != expected) {
    return refuse(RefusalReason::kBadSize, type + ".data_size",
                  "contradicts the other sizes (got " + std::to_string(layout.data_size) + ", expected " +
                      product_text(layout) + " * " + std::to_string(layout.element_bytes) + ")",
                  header);
  }
  const auto remaining = static_cast<std::int64_t>(layout.remaining);
  if (remaining == expected) return std::nullopt;
  return refuse(remaining < expected ? RefusalReason::kTruncated : RefusalReason::kTrailingBytes,
                type + ".data",
                std::string(remaining < expected ? "the message ends" : "the message goes on") + " (got " +
                    std::to_string(remaining) + " bytes, expected " + std::to_string(expected) + ")",
                header);
}

std::string printable(std::string_view text) {
  constexpr std::size_t kMax = 40;
  std::string result(text.substr(0, kMax));
  std::replace_if(
      result.begin(), result.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  if (text.size() > kMax) result += "...";
  return result;
}

std::string number(double value) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

}  // namespace graspd

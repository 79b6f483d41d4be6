// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What the cloud decoders share: the header that both types start with, and refusals.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "service/transport/byte_reader.hpp"
#include "service/transport/frame.hpp"
#include "service/transport/refusal.hpp"

namespace graspd {

/// utime, seq and frame name, from where the reader stands after the fingerprint; defaults from the first
/// that fails on.
[[nodiscard]] FrameHeader read_header(ByteReader& reader, const DecodeLimits& limits);

/// place: member of the message.
[[nodiscard]] Refusal refuse(RefusalReason reason, std::string_view place, const std::string& what,
                             const FrameHeader& header);
/// What the reader failed on.
[[nodiscard]] Refusal refuse(const ByteReader& reader, std::string_view type, const FrameHeader& header);

/// Checks that hold for points and pixels alike: the sizes, their product against the limit and against
/// data_size, and that the bytes that are left are the data, no fewer and no more.
struct DataLayout {
  std::string_view type;
  std::int32_t width = 0;
  std::int32_t height = 0;
  std::int32_t element_bytes = 0;
  std::int32_t data_size = 0;
  std::size_t remaining = 0;
};
[[nodiscard]] std::optional<Refusal> check_layout(const DataLayout& layout, const DecodeLimits& limits,
                                                  const FrameHeader& header);

/// Bytes of strangers, fit for a log line: everything but printable ASCII as '?', shortened to 40 characters.
[[nodiscard]] std::string printable(std::string_view text);

/// Locale-free, short.
[[nodiscard]] std::string number(double value);

}  // namespace graspd

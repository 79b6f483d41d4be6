// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Why a message is not used, and how large one may be.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <string>
#include <string_view>

#include "service/pipeline/config_fields.hpp"

namespace graspd {

enum class RefusalReason : std::uint8_t {
  kUnknownType,     ///< the fingerprint is of no type that clouds come in
  kTooLarge,        ///< more bytes or points than the limits allow
  kTruncated,       ///< ends before its last member
  kTrailingBytes,   ///< goes on after its last member
  kBadString,       ///< without its final NUL, or with a control character
  kBadSize,         ///< lengths, counts or sizes that cannot be or contradict each other
  kMissingField,    ///< a cloud without x, y or z
  kBadField,        ///< of the wrong type, outside the point, or there twice
  kBadCalibration,  ///< intrinsics, depth scale or viewpoint that no sensor has
  kBadCompression,  ///< compressed pixels that cannot be read, or are not of the image's size
  kUnsigned,        ///< no sealed_t where only those are taken
  kForged,          ///< a seal that no key of ours gives: wrong key, other channel, changed on the way
  kReplayed,        ///< a sealed message that has come before
  kStale,           ///< a sealed message of another time
};
inline constexpr std::size_t kNumRefusalReasons = static_cast<std::size_t>(RefusalReason::kStale) + 1;

/// lower_snake, as on the wire.
[[nodiscard]] std::string_view name(RefusalReason reason);

/// The text is one printable line: member, value, what was expected. The header's members are defaults where
/// the message did not get that far.
struct Refusal {
  RefusalReason reason = RefusalReason::kUnknownType;
  std::string text;
  std::int64_t utime = 0;
  std::int64_t seq = -1;
  std::pmr::string frame_name;
};

struct DecodeLimits {
  int max_message_bytes = 128 << 20;
  int max_points = 16'000'000;
  int max_fields = 64;        ///< of a point
  int max_name_length = 255;  ///< of a frame or a field

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& v) {
    v("max_message_bytes", self.max_message_bytes, Range{1024, 1 << 28},
      "larger messages are refused [bytes]");
    v("max_points", self.max_points, Range{1, 1e8},
      "clouds and images with more points or pixels are refused");
    v("max_fields", self.max_fields, Range{3, 1024}, "clouds with more fields a point are refused");
    v("max_name_length", self.max_name_length, Range{1, 4096},
      "longest name of a frame or field [characters]");
  }
};

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/segmentation_request_codec.hpp"

#include "service/transport/byte_reader.hpp"
#include "service/transport/encoding.hpp"
#include "service/transport/wire_layout.hpp"

namespace graspd {
namespace {

constexpr std::int32_t kLongestChannel = 63;  // LCM's limit

}  // namespace

void encode(const segmentation_request_t& request, std::vector<std::byte>& buffer) {
  encode_message(request, buffer);
}

std::vector<std::byte> encode(const segmentation_request_t& request) {
  return encoded(request);
}

std::optional<segmentation_request_t> decode_segmentation_request(std::span<const std::byte> message) {
  if (fingerprint(message) != kSegmentationRequestFingerprint) return std::nullopt;
  ByteReader reader(message.subspan(kFingerprintBytes));
  segmentation_request_t request;
  request.utime = reader.int64("utime");
  request.source_channel = reader.string("source_channel", kLongestChannel);
  request.seconds = reader.float64("seconds");
  reader.finish();
  // A NaN fails both.
  const bool holds_for_a_time = request.seconds > 0 && request.seconds <= kLongestRequest_s;
  if (!reader.ok() || !holds_for_a_time) return std::nullopt;
  return request;
}

}  // namespace graspd

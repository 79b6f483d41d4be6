// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/cloud_decoder.hpp"

#include <array>
#include <charconv>

#include "service/transport/decoding.hpp"
#include "service/transport/depth_image_decoder.hpp"
#include "service/transport/point_cloud_decoder.hpp"
#include "service/transport/wire_layout.hpp"

namespace graspd {
namespace {

std::string hex(std::uint64_t value) {
  std::array<char, 16> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value, 16).ptr;
  const auto length = static_cast<std::size_t>(end - digits.data());
  return "0x" + std::string(digits.size() - length, '0') + std::string(digits.data(), length);
}

std::string unknown_type_text(std::uint64_t type) {
  const std::string name(type_name(type));
  return "not a cloud (got " + (name.empty() ? hex(type) : name) + ", expected point_cloud_t " +
         hex(kPointCloudFingerprint) + " or depth_image_t " + hex(kDepthImageFingerprint) + ")";
}

/// Type and size.
std::optional<Refusal> check_envelope(std::span<const std::byte> message, const DecodeLimits& limits) {
  const std::optional<std::uint64_t> type = fingerprint(message);
  if (!type) {
    return refuse(RefusalReason::kTruncated, "fingerprint",
                  "the message ends (got " + std::to_string(message.size()) + " bytes, expected at least 8)",
                  {});
  }
  if (*type != kPointCloudFingerprint && *type != kDepthImageFingerprint) {
    return refuse(RefusalReason::kUnknownType, "fingerprint", unknown_type_text(*type), {});
  }
  if (message.size() > static_cast<std::size_t>(limits.max_message_bytes)) {
    return refuse(RefusalReason::kTooLarge, "message",
                  "too large (got " + std::to_string(message.size()) + " bytes, expected at most " +
                      std::to_string(limits.max_message_bytes) + ")",
                  peek_header(message, limits));
  }
  return std::nullopt;
}

bool is_point_cloud(std::span<const std::byte> message) {
  return fingerprint(message) == kPointCloudFingerprint;
}

}  // namespace

std::variant<Frame, Refusal> decode_cloud(std::span<const std::byte> message, const DecodeLimits& limits) {
  if (auto refusal = check_envelope(message, limits)) return *std::move(refusal);
  return is_point_cloud(message) ? decode_point_cloud(message, limits) : decode_depth_image(message, limits);
}

std::optional<Refusal> check_cloud(std::span<const std::byte> message, const DecodeLimits& limits) {
  if (auto refusal = check_envelope(message, limits)) return refusal;
  return is_point_cloud(message) ? check_point_cloud(message, limits) : check_depth_image(message, limits);
}

FrameHeader peek_header(std::span<const std::byte> message, const DecodeLimits& limits) {
  const std::optional<std::uint64_t> type = fingerprint(message);
  if (!type || (*type != kPointCloudFingerprint && *type != kDepthImageFingerprint)) return {};
  ByteReader reader(message.subspan(kFingerprintBytes));
  return read_header(reader, limits);
}

}  // namespace graspd

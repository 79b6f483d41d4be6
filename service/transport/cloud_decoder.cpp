// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/cloud_decoder.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "service/transport/decoding.hpp"
#include "service/transport/depth_image_decoder.hpp"
#include "service/transport/foreign_cloud_decoder.hpp"
#include "service/transport/foreign_image_decoder.hpp"
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

CloudType own_point_cloud_type() {
  return {kPointCloudFingerprint, "point_cloud_t", read_header,
          [](std::span<const std::byte> message, const DecodeLimits& limits, const CloudInput&) {
            return check_point_cloud(message, limits);
          },
          [](std::span<const std::byte> message, const DecodeLimits& limits, const CloudInput&) {
            return decode_point_cloud(message, limits);
          }};
}

CloudType own_depth_image_type() {
  return {kDepthImageFingerprint, "depth_image_t", read_header,
          [](std::span<const std::byte> message, const DecodeLimits& limits, const CloudInput&) {
            return check_depth_image(message, limits);
          },
          [](std::span<const std::byte> message, const DecodeLimits& limits, const CloudInput&) {
            return decode_depth_image(message, limits);
          }};
}

/// Of the message's fingerprint; null for others.
const CloudType* find_type(std::optional<std::uint64_t> fingerprint) {
  static const std::array kTypes{own_point_cloud_type(),  own_depth_image_type(),
                                 lcmt_point_cloud_type(), pointcloud2_type(),
                                 pointcloud_type(),       sensor_msgs_point_cloud2_type(),
                                 images_type(),           lcmt_image_array_type()};
  const auto found =
      std::find_if(kTypes.begin(), kTypes.end(), [&](const auto& t) { return t.fingerprint == fingerprint; });
  return found == kTypes.end() ? nullptr : &*found;
}

std::string unknown_type_text(std::uint64_t type) {
  const std::string name(type_name(type));
  return "not a cloud (got " + (name.empty() ? hex(type) : name) + ", expected point_cloud_t " +
         hex(kPointCloudFingerprint) + ", depth_image_t " + hex(kDepthImageFingerprint) +
         " or a type of others that lcmtypes/README.md lists)";
}

/// Type and size.
std::optional<Refusal> check_envelope(std::span<const std::byte> message, const CloudType* type,
                                      const DecodeLimits& limits) {
  const std::optional<std::uint64_t> found = fingerprint(message);
  if (!found) {
    return refuse(RefusalReason::kTruncated, "fingerprint",
                  "the message ends (got " + std::to_string(message.size()) + " bytes, expected at least 8)",
                  {});
  }
  if (type == nullptr) {
    return refuse(RefusalReason::kUnknownType, "fingerprint", unknown_type_text(*found), {});
  }
  if (message.size() > static_cast<std::size_t>(limits.max_message_bytes)) {
    return refuse(RefusalReason::kTooLarge, "message",
                  "too large (got " + std::to_string(message.size()) + " bytes, expected at most " +
                      std::to_string(limits.max_message_bytes) + ")",
                  peek_header(message, limits));
  }
  return std::nullopt;
}

}  // namespace

std::variant<Frame, Refusal> decode_cloud(std::span<const std::byte> message, const DecodeLimits& limits,
                                          const CloudInput& input) {
  const CloudType* type = find_type(fingerprint(message));
  if (auto refusal = check_envelope(message, type, limits)) return *std::move(refusal);
  return type->decode(message, limits, input);
}

std::optional<Refusal> check_cloud(std::span<const std::byte> message, const DecodeLimits& limits,
                                   const CloudInput& input) {
  const CloudType* type = find_type(fingerprint(message));
  if (auto refusal = check_envelope(message, type, limits)) return refusal;
  return type->check(message, limits, input);
}

FrameHeader peek_header(std::span<const std::byte> message, const DecodeLimits& limits) {
  const CloudType* type = find_type(fingerprint(message));
  if (type == nullptr) return {};
  ByteReader reader(message.subspan(kFingerprintBytes));
  return type->read_header(reader, limits);
}

}  // namespace graspd

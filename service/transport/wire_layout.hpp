// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What is fixed about the types on the wire and not in their generated code.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace graspd {

/// The first eight bytes of a message, big-endian; a test holds them equal to the generated types'.
inline constexpr std::uint64_t kPointCloudFingerprint = 0x19d75af77ba18842;
inline constexpr std::uint64_t kDepthImageFingerprint = 0xa92f072e49028cde;
inline constexpr std::uint64_t kHandleListFingerprint = 0x9bf98642e84fd318;
inline constexpr std::uint64_t kStatusFingerprint = 0x3e93e45b223e4491;
inline constexpr std::uint64_t kControlFingerprint = 0x1a187596f91f8882;
inline constexpr std::uint64_t kSealedFingerprint = 0xa70cb71154832893;
inline constexpr std::uint64_t kSegmentationFingerprint = 0xbb512cf7d3d00ed5;
inline constexpr std::uint64_t kSegmentationRequestFingerprint = 0x59367a3b2c1bd887;

/// Of types of others that clouds come in, too (lcmtypes/README.md).
inline constexpr std::uint64_t kLcmtPointCloudFingerprint = 0x17f2c128b5d25a95;
inline constexpr std::uint64_t kPointcloud2Fingerprint = 0x0bcd5ce4bf5a1b4a;
inline constexpr std::uint64_t kPointcloudFingerprint = 0x0d89dc76eb295069;
inline constexpr std::uint64_t kSensorMsgsPointCloud2Fingerprint = 0xf5eb3da1c2853175;
inline constexpr std::uint64_t kImagesFingerprint = 0x20ba4f05e8f5e33a;
inline constexpr std::uint64_t kLcmtImageArrayFingerprint = 0x1572a7d08d9022e6;

inline constexpr std::size_t kFingerprintBytes = 8;

/// Values of point_field_t.datatype.
inline constexpr std::int8_t kFirstDatatype = 1;
inline constexpr std::int8_t kFloat32 = 7;
inline constexpr std::int8_t kFloat64 = 8;
inline constexpr std::int8_t kLastDatatype = kFloat64;

/// Bytes of one value of a datatype; 0 for none of them.
[[nodiscard]] constexpr std::size_t datatype_size(std::int8_t datatype) {
  constexpr std::size_t kSizes[] = {0, 1, 1, 2, 2, 4, 4, 4, 8};
  return datatype >= kFirstDatatype && datatype <= kLastDatatype ? kSizes[datatype] : 0;
}

/// Nothing when the message is shorter than a fingerprint.
[[nodiscard]] std::optional<std::uint64_t> fingerprint(std::span<const std::byte> message);

/// The name of a type of ours; empty for others.
[[nodiscard]] std::string_view type_name(std::uint64_t fingerprint);

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/wire_layout.hpp"

#include "service/transport/byte_reader.hpp"

namespace graspd {

std::optional<std::uint64_t> fingerprint(std::span<const std::byte> message) {
  ByteReader reader(message);
  const auto value = static_cast<std::uint64_t>(reader.int64("fingerprint"));
  if (!reader.ok()) return std::nullopt;
  return value;
}

std::string_view type_name(std::uint64_t fingerprint) {
  switch (fingerprint) {
    case kPointCloudFingerprint:
      return "point_cloud_t";
    case kDepthImageFingerprint:
      return "depth_image_t";
    case kHandleListFingerprint:
      return "handle_list_t";
    case kStatusFingerprint:
      return "status_t";
    case kSealedFingerprint:
      return "sealed_t";
    case kControlFingerprint:
      return "control_t";
    case kSegmentationFingerprint:
      return "segmentation_t";
    case kSegmentationRequestFingerprint:
      return "segmentation_request_t";
    default:
      return {};
  }
}

}  // namespace graspd

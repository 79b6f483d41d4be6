// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/common/cloud_colors.hpp"

#include <cstring>
#include <optional>
#include <string_view>

#include "service/transport/byte_reader.hpp"
#include "service/transport/wire_layout.hpp"

namespace graspd {
namespace {

constexpr std::size_t kColorBytes = 4;
constexpr std::size_t kMinFieldBytes = 14;
constexpr std::size_t kViewpointBytes = 3 * 8;

/// Where the colour is within a point; nothing: there is none.
std::optional<std::size_t> read_color_offset(ByteReader& reader, const DecodeLimits& limits) {
  std::optional<std::size_t> found;
  const std::int32_t fields = reader.count("num_fields", limits.max_fields, kMinFieldBytes);
  for (std::int32_t i = 0; i < fields; ++i) {
    const std::string_view name = reader.string("fields.name", limits.max_name_length);
    const std::int32_t offset = reader.int32("fields.offset");
    const std::int8_t datatype = reader.int8("fields.datatype");
    const std::int32_t count = reader.int32("fields.count");
    // PCL keeps the same four bytes in a float.
    if (name == "rgb" && offset >= 0 && count == 1 && datatype_size(datatype) == kColorBytes)
      found = static_cast<std::size_t>(offset);
  }
  return found;
}

}  // namespace

std::vector<std::uint32_t> cloud_colors(std::span<const std::byte> message, const DecodeLimits& limits) {
  if (fingerprint(message) != kPointCloudFingerprint) return {};
  ByteReader reader(message);
  reader.skip("fingerprint, utime, seq", kFingerprintBytes + 2 * sizeof(std::int64_t));
  (void)reader.string("frame_name", limits.max_name_length);
  reader.skip("viewpoint", kViewpointBytes);
  const std::int64_t width = reader.int32("width");
  const std::int64_t height = reader.int32("height");
  const std::optional<std::size_t> offset = read_color_offset(reader, limits);
  const std::int64_t step = reader.int32("point_step");
  (void)reader.int32("data_size");
  if (!reader.ok() || !offset || width <= 0 || height <= 0 || step <= 0 || width * height > limits.max_points)
    return {};
  const auto points = static_cast<std::size_t>(width * height);
  const auto point_bytes = static_cast<std::size_t>(step);
  if (*offset + kColorBytes > point_bytes || reader.remaining() / point_bytes < points) return {};
  const std::span<const std::byte> data = reader.bytes("data", points * point_bytes);
  std::vector<std::uint32_t> colors(points);
  for (std::size_t i = 0; i < points; ++i)
    std::memcpy(&colors[i], data.data() + i * point_bytes + *offset, kColorBytes);
  return colors;
}

}  // namespace graspd

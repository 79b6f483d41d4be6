// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/label_decoder.hpp"

#include <cstring>

#include "service/transport/cloud_decoder.hpp"
#include "service/transport/decoding.hpp"
#include "service/transport/wire_layout.hpp"

namespace graspd {
namespace {

constexpr std::int8_t kUint8 = 2, kUint16 = 4, kUint32 = 6;

/// Where the labels are in a point.
struct LabelField {
  std::int8_t datatype = 0;  ///< 0: there is none
  std::size_t offset = 0;    ///< [bytes]
};

LabelField read_fields(ByteReader& reader, const DecodeLimits& limits) {
  LabelField label;
  const std::int32_t fields = reader.count("num_fields", limits.max_fields, 14);
  for (std::int32_t i = 0; i < fields && reader.ok(); ++i) {
    const std::string_view name = reader.string("fields.name", limits.max_name_length);
    const std::int32_t offset = reader.int32("fields.offset");
    const std::int8_t datatype = reader.int8("fields.datatype");
    reader.skip("fields.count", sizeof(std::int32_t));
    if (name == "label" && (datatype == kUint8 || datatype == kUint16 || datatype == kUint32))
      label = {datatype, static_cast<std::size_t>(offset)};
  }
  return label;
}

}  // namespace

std::vector<std::uint32_t> decode_labels(std::span<const std::byte> message) {
  const DecodeLimits limits;
  // What passes has one value a field, all fields inside the point, and all points inside the data.
  if (fingerprint(message) != kPointCloudFingerprint || check_cloud(message, limits)) return {};
  ByteReader reader(message.subspan(kFingerprintBytes));
  (void)read_header(reader, limits);
  reader.skip("viewpoint", 3 * sizeof(double));
  const auto width = static_cast<std::size_t>(reader.int32("width"));
  const auto height = static_cast<std::size_t>(reader.int32("height"));
  const LabelField field = read_fields(reader, limits);
  const auto step = static_cast<std::size_t>(reader.int32("point_step"));
  reader.skip("data_size", sizeof(std::int32_t));
  if (!reader.ok() || field.datatype == 0) return {};
  const std::size_t bytes = datatype_size(field.datatype);
  const auto data = reader.bytes("data", reader.remaining());
  std::vector<std::uint32_t> labels(width * height);
  for (std::size_t i = 0; i < labels.size(); ++i)
    std::memcpy(&labels[i], data.data() + i * step + field.offset, bytes);  // little-endian, as the host
  return labels;
}

}  // namespace graspd

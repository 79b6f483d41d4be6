// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/foreign_cloud_decoder.hpp"

#include <array>
#include <limits>
#include <utility>

#include "service/transport/decoding.hpp"
#include "service/transport/packed_points.hpp"
#include "service/transport/wire_layout.hpp"

namespace graspd {
namespace {

constexpr std::int32_t kMaxBytes = std::numeric_limits<std::int32_t>::max();
constexpr std::size_t kMinFieldBytes = 14;  // a field with an empty name
constexpr std::int64_t kDrakeIsBigEndian = 1;
constexpr std::array<PackedField, 3> kPackedFloats{
    {{"x", 0, kFloat32, 1}, {"y", 4, kFloat32, 1}, {"z", 8, kFloat32, 1}}};

/// The same in all of these types.
void read_fields(ByteReader& reader, std::int32_t count, const DecodeLimits& limits,
                 std::pmr::vector<PackedField>& fields) {
  fields.resize(static_cast<std::size_t>(count));
  for (PackedField& field : fields) {
    field.name = reader.string("fields.name", limits.max_name_length);
    field.offset = reader.int32("fields.offset");
    field.datatype = static_cast<std::uint8_t>(reader.int8("fields.datatype"));
    field.count = reader.int32("fields.count");
  }
}

FrameHeader read_drake_header(ByteReader& reader, const DecodeLimits& limits) {
  FrameHeader header;
  header.utime = reader.int64("utime");
  header.frame_name = reader.text("frame_name", limits.max_name_length);
  return header;
}

PackedPoints read_drake(ByteReader& reader, const DecodeLimits& limits) {
  PackedPoints p;
  p.header = read_drake_header(reader, limits);
  p.width = reader.int64("width");
  p.height = reader.int64("height");
  read_fields(reader, reader.count("num_fields", limits.max_fields, kMinFieldBytes), limits, p.fields);
  p.big_endian = (reader.int64("flags") & kDrakeIsBigEndian) != 0;
  p.point_step = reader.int32("point_step");
  p.row_step = reader.int64("row_step");
  reader.skip("filler", reader.byte_count16("filler_size"));
  p.data = reader.bytes("data", reader.byte_count64("data_size"));
  return p;
}

FrameHeader read_bot_core_header(ByteReader& reader, const DecodeLimits& limits) {
  FrameHeader header;
  header.utime = reader.int64("utime");
  const std::int32_t seq = reader.int32("seq");
  if (reader.ok()) header.seq = seq;
  header.frame_name = reader.text("frame_id", limits.max_name_length);
  return header;
}

PackedPoints read_pointcloud2(ByteReader& reader, const DecodeLimits& limits) {
  PackedPoints p;
  p.header = read_bot_core_header(reader, limits);
  p.height = reader.int32("height");
  p.width = reader.int32("width");
  read_fields(reader, reader.count("nfields", limits.max_fields, kMinFieldBytes), limits, p.fields);
  p.big_endian = reader.int8("is_bigendian") != 0;
  p.point_step = reader.int32("point_step");
  p.row_step = reader.int32("row_step");
  p.data = reader.bytes("data", static_cast<std::size_t>(reader.count("data_nbytes", kMaxBytes, 1)));
  reader.skip("is_dense", 1);
  return p;
}

/// Its points are members, so they are big-endian as everything in LCM. The channels are passed over.
PackedPoints read_pointcloud(ByteReader& reader, const DecodeLimits& limits) {
  constexpr std::int32_t kPointBytes = 3 * sizeof(float);
  PackedPoints p;
  p.header = read_bot_core_header(reader, limits);
  p.width = reader.count("n_points", kMaxBytes, kPointBytes);
  p.height = 1;
  p.fields.assign(kPackedFloats.begin(), kPackedFloats.end());
  p.big_endian = true;
  p.point_step = kPointBytes;
  p.data = reader.bytes("points", static_cast<std::size_t>(p.width) * kPointBytes);
  const std::int32_t channels = reader.count("n_channels", limits.max_fields, sizeof(std::int32_t) + 1);
  for (std::int32_t i = 0; i < channels; ++i) (void)reader.string("channel_names", limits.max_name_length);
  reader.skip("channels",
              static_cast<std::size_t>(channels) * static_cast<std::size_t>(p.width) * sizeof(float));
  return p;
}

/// The lengths of its arrays, which come before everything else.
struct DimosLengths {
  std::int32_t fields = 0;
  std::int32_t data = 0;
};

DimosLengths read_dimos_lengths(ByteReader& reader, const DecodeLimits& limits) {
  DimosLengths lengths;
  lengths.fields = reader.count("fields_length", limits.max_fields, kMinFieldBytes);
  lengths.data = reader.count("data_length", kMaxBytes, 1);
  return lengths;
}

FrameHeader read_dimos_stamp(ByteReader& reader, const DecodeLimits& limits) {
  FrameHeader header;
  const std::int32_t seq = reader.int32("header.seq");
  if (reader.ok()) header.seq = seq;
  const std::int64_t seconds = reader.int32("header.stamp.sec");
  const std::int64_t nanoseconds = reader.int32("header.stamp.nsec");
  if (reader.ok()) header.utime = seconds * 1'000'000 + nanoseconds / 1000;
  header.frame_name = reader.text("header.frame_id", limits.max_name_length);
  return header;
}

FrameHeader read_dimos_header(ByteReader& reader, const DecodeLimits& limits) {
  (void)read_dimos_lengths(reader, limits);
  return read_dimos_stamp(reader, limits);
}

PackedPoints read_dimos(ByteReader& reader, const DecodeLimits& limits) {
  PackedPoints p;
  const DimosLengths lengths = read_dimos_lengths(reader, limits);
  p.header = read_dimos_stamp(reader, limits);
  p.height = reader.int32("height");
  p.width = reader.int32("width");
  if (reader.ok()) read_fields(reader, lengths.fields, limits, p.fields);
  p.big_endian = reader.int8("is_bigendian") != 0;
  p.point_step = reader.int32("point_step");
  p.row_step = reader.int32("row_step");
  p.data = reader.bytes("data", static_cast<std::size_t>(lengths.data));
  reader.skip("is_dense", 1);
  return p;
}

using Read = PackedPoints (*)(ByteReader&, const DecodeLimits&);

std::variant<PackedPoints, Refusal> parse(Read read, std::string_view type,
                                          std::span<const std::byte> message, const DecodeLimits& limits) {
  ByteReader reader(message);
  reader.skip("fingerprint", kFingerprintBytes);
  PackedPoints points = read(reader, limits);
  reader.finish();
  if (!reader.ok()) return refuse(reader, type, points.header);
  if (auto refusal = check_packed_points(type, points, limits)) return *std::move(refusal);
  return points;
}

/// Type: kFingerprint, kName, kRead and kReadHeader of one of them.
template <class Type>
CloudType cloud_type() {
  CloudType type{Type::kFingerprint, Type::kName, Type::kReadHeader, nullptr, nullptr};
  type.check = [](std::span<const std::byte> message, const DecodeLimits& limits,
                  const CloudInput&) -> std::optional<Refusal> {
    auto parsed = parse(Type::kRead, Type::kName, message, limits);
    if (auto* refusal = std::get_if<Refusal>(&parsed)) return std::move(*refusal);
    return std::nullopt;
  };
  type.decode = [](std::span<const std::byte> message, const DecodeLimits& limits,
                   const CloudInput& input) -> std::variant<Frame, Refusal> {
    auto parsed = parse(Type::kRead, Type::kName, message, limits);
    if (auto* refusal = std::get_if<Refusal>(&parsed)) return std::move(*refusal);
    return unpack(std::get<PackedPoints>(std::move(parsed)), input);
  };
  return type;
}

struct LcmtPointCloud {
  static constexpr std::uint64_t kFingerprint = kLcmtPointCloudFingerprint;
  static constexpr std::string_view kName = "lcmt_point_cloud";
  static constexpr auto kReadHeader = read_drake_header;
  static constexpr Read kRead = read_drake;
};
struct Pointcloud2 {
  static constexpr std::uint64_t kFingerprint = kPointcloud2Fingerprint;
  static constexpr std::string_view kName = "pointcloud2_t";
  static constexpr auto kReadHeader = read_bot_core_header;
  static constexpr Read kRead = read_pointcloud2;
};
struct Pointcloud {
  static constexpr std::uint64_t kFingerprint = kPointcloudFingerprint;
  static constexpr std::string_view kName = "pointcloud_t";
  static constexpr auto kReadHeader = read_bot_core_header;
  static constexpr Read kRead = read_pointcloud;
};
struct SensorMsgsPointCloud2 {
  static constexpr std::uint64_t kFingerprint = kSensorMsgsPointCloud2Fingerprint;
  static constexpr std::string_view kName = "sensor_msgs.PointCloud2";
  static constexpr auto kReadHeader = read_dimos_header;
  static constexpr Read kRead = read_dimos;
};

}  // namespace

CloudType lcmt_point_cloud_type() {
  return cloud_type<LcmtPointCloud>();
}
CloudType pointcloud2_type() {
  return cloud_type<Pointcloud2>();
}
CloudType pointcloud_type() {
  return cloud_type<Pointcloud>();
}
CloudType sensor_msgs_point_cloud2_type() {
  return cloud_type<SensorMsgsPointCloud2>();
}

}  // namespace graspd

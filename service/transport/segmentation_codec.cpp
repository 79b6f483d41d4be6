// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/segmentation_codec.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_set>

#include "service/transport/byte_reader.hpp"
#include "service/transport/encoding.hpp"
#include "service/transport/message_parts.hpp"
#include "service/transport/wire_layout.hpp"

namespace graspd {
namespace {

constexpr std::size_t kPointBytes = segmentation_t::POINT_BYTES;
constexpr std::int32_t kMaxPoints = 100'000'000;
constexpr std::int32_t kMaxSegments = 1'000'000;
constexpr std::size_t kMinSegmentBytes = 3 * 4 + 9 * 8 + 2 * 4 + 4 + 1 + 4;
constexpr double kLargestNumber = 65535;  // of an unsigned 16-bit number
constexpr double kSmallestStep = 1e-9;    // where all points are one
constexpr double kSupportCube = 8;        // voxels along its edge

using Record = std::array<std::uint16_t, kPointBytes / 2>;  // x, y, z, segment, flags

Record read_record(const std::uint8_t* bytes) {
  Record record;
  for (std::size_t i = 0; i < record.size(); ++i)
    record[i] = static_cast<std::uint16_t>(bytes[2 * i] | (bytes[2 * i + 1] << 8));
  return record;
}

void write_record(const Record& record, std::uint8_t* bytes) {
  for (std::size_t i = 0; i < record.size(); ++i) {
    bytes[2 * i] = static_cast<std::uint8_t>(record[i] & 0xff);
    bytes[2 * i + 1] = static_cast<std::uint8_t>(record[i] >> 8);
  }
}

void copy(const Eigen::Vector3d& from, double (&to)[3]) {
  for (int i = 0; i < 3; ++i) to[i] = from[i];
}

segment_t wire_segment(const SegmentReport& report, std::int32_t id, const Eigen::Isometry3d& T) {
  segment_t result;
  result.id = id;
  result.object = report.object;
  result.num_points = report.num_points;
  copy(T * report.centroid.cast<double>(), result.centroid);
  copy(T.linear() * report.normal.cast<double>(), result.normal);
  copy(T.linear() * report.major.cast<double>(), result.major_axis);
  result.num_candidates = report.num_candidates;
  result.num_handles = report.num_handles;
  if (report.num_handles == 0) result.reason = name(report.reason());
  result.failures = wire_failures(report.failures);
  result.num_failures = static_cast<std::int32_t>(result.failures.size());
  return result;
}

bool is_support(const Surfaces& surfaces, std::size_t i) {
  return surfaces.support && surfaces.support->is_support[i] != 0;
}

std::uint16_t wire_flags(const Surfaces& surfaces, std::size_t i) {
  return static_cast<std::uint16_t>((surfaces.is_edge[i] != 0 ? segmentation_t::EDGE : 0) |
                                    (is_support(surfaces, i) ? segmentation_t::SUPPORT : 0));
}

std::uint16_t wire_number(std::int32_t segment) {
  return segment < 0 || segment >= segmentation_t::NO_SEGMENT
             ? static_cast<std::uint16_t>(segmentation_t::NO_SEGMENT)
             : static_cast<std::uint16_t>(segment);
}

std::uint64_t cube_of(const Eigen::Vector3f& point, float edge_m) {
  std::uint64_t cube = 0;
  for (const float c : point) {
    const auto k = static_cast<std::int64_t>(std::clamp(std::floor(c / edge_m), -1e6f, 1e6f));
    cube = (cube << 21) | (static_cast<std::uint64_t>(k + 1'000'000) & 0x1fffff);
  }
  return cube;
}

/// Of the support one point a cube will do.
std::vector<std::size_t> points_to_send(const Surfaces& surfaces, double voxel_m) {
  const auto edge_m = static_cast<float>(kSupportCube * voxel_m);
  std::unordered_set<std::uint64_t> taken;
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < surfaces.cloud.size(); ++i) {
    const bool is_plain = edge_m > 0 && is_support(surfaces, i) && surfaces.is_edge[i] == 0;
    if (!is_plain || taken.insert(cube_of(surfaces.cloud.point(i), edge_m)).second) chosen.push_back(i);
  }
  return chosen;
}

void pack_points(const Surfaces& surfaces, const Eigen::Isometry3d& T, segmentation_t& result) {
  const std::vector<std::size_t> chosen = points_to_send(surfaces, result.voxel_size);
  Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(chosen.size()));
  Eigen::Index column = 0;
  for (const std::size_t i : chosen) points.col(column++) = T * surfaces.cloud.point(i).cast<double>();
  const Eigen::Vector3d min = points.rowwise().minCoeff();
  const double extent = (points.rowwise().maxCoeff() - min).maxCoeff();
  result.step = std::max(extent / kLargestNumber, kSmallestStep);
  copy(min, result.origin);
  result.num_points = static_cast<std::int32_t>(chosen.size());
  result.data.resize(chosen.size() * kPointBytes);
  result.data_size = static_cast<std::int32_t>(result.data.size());
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const Eigen::Vector3d steps = (points.col(static_cast<Eigen::Index>(k)) - min) / result.step;
    Record record;
    for (int axis = 0; axis < 3; ++axis)
      record[static_cast<std::size_t>(axis)] =
          static_cast<std::uint16_t>(std::clamp(std::round(steps[axis]), 0.0, kLargestNumber));
    record[3] = wire_number(surfaces.segments.of_point[chosen[k]]);
    record[4] = wire_flags(surfaces, chosen[k]);
    write_record(record, &result.data[k * kPointBytes]);
  }
}

void write_plane(const Plane& plane, const Eigen::Isometry3d& T, double (&to)[4]) {
  const Eigen::Vector3d normal = plane.normal.cast<double>();
  const Eigen::Vector3d moved = T.linear() * normal;
  for (int i = 0; i < 3; ++i) to[i] = moved[i];
  to[3] = double{plane.offset_m} - moved.dot(T.translation());
}

void read(ByteReader& reader, segment_t& segment) {
  segment.id = reader.int32("segments.id");
  segment.object = reader.int32("segments.object");
  segment.num_points = reader.int32("segments.num_points");
  reader.float64s("segments.centroid", segment.centroid);
  reader.float64s("segments.normal", segment.normal);
  reader.float64s("segments.major_axis", segment.major_axis);
  segment.num_candidates = reader.int32("segments.num_candidates");
  segment.num_handles = reader.int32("segments.num_handles");
  segment.reason = reader.string("segments.reason", kMaxTextLength);
  segment.num_failures = read_reason_counts(reader, segment.failures);
}

void read_points(ByteReader& reader, segmentation_t& result) {
  result.num_points = reader.count("num_points", kMaxPoints, kPointBytes);
  result.data_size = reader.int32("data_size");
  const auto size = static_cast<std::size_t>(result.num_points) * kPointBytes;
  const auto view = reader.bytes("data", size);
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(view.data());
  result.data.assign(bytes, bytes + view.size());
}

bool is_consistent(const segmentation_t& result) {
  if (static_cast<std::size_t>(result.data_size) != result.data.size()) return false;
  for (std::size_t i = 0; i < result.data.size(); i += kPointBytes) {
    const std::uint16_t segment = read_record(&result.data[i])[3];
    if (segment != segmentation_t::NO_SEGMENT && segment >= result.num_segments) return false;
  }
  return true;
}

}  // namespace

segmentation_t make_segmentation(const HandleListHeader& header, const Detection& detection,
                                 const Surfaces& surfaces, const Eigen::Isometry3f& T_target_cloud) {
  const Eigen::Isometry3d T = T_target_cloud.cast<double>();
  segmentation_t result{};
  result.utime = header.utime;
  result.seq = header.seq;
  result.source_channel = header.source_channel;
  result.frame_name = header.frame_name;
  result.config_revision = header.config_revision;
  result.voxel_size = header.voxel_m;
  pack_points(surfaces, T, result);
  if (surfaces.support) write_plane(surfaces.support->plane, T, result.support_plane);
  for (const SegmentReport& report : detection.segments) {
    const auto id = static_cast<std::int32_t>(result.segments.size());
    result.segments.push_back(wire_segment(report, id, T));
  }
  result.num_segments = static_cast<std::int32_t>(result.segments.size());
  return result;
}

void encode(const segmentation_t& segmentation, std::vector<std::byte>& buffer) {
  require_count("segmentation_t.data_size", segmentation.data_size, segmentation.data.size());
  require_count("segmentation_t.num_segments", segmentation.num_segments, segmentation.segments.size());
  for (const segment_t& segment : segmentation.segments)
    require_count("segment_t.num_failures", segment.num_failures, segment.failures.size());
  encode_message(segmentation, buffer);
}

std::vector<std::byte> encode(const segmentation_t& segmentation) {
  return encoded(segmentation);
}

std::optional<segmentation_t> decode_segmentation(std::span<const std::byte> message) {
  if (fingerprint(message) != kSegmentationFingerprint) return std::nullopt;
  ByteReader reader(message.subspan(kFingerprintBytes));
  segmentation_t result;
  result.utime = reader.int64("utime");
  result.seq = reader.int64("seq");
  result.source_channel = reader.string("source_channel", kMaxTextLength);
  result.frame_name = reader.string("frame_name", kMaxTextLength);
  result.config_revision = reader.int64("config_revision");
  result.voxel_size = reader.float64("voxel_size");
  reader.float64s("origin", result.origin);
  result.step = reader.float64("step");
  read_points(reader, result);
  reader.float64s("support_plane", result.support_plane);
  result.num_segments = reader.count("num_segments", kMaxSegments, kMinSegmentBytes);
  result.segments.resize(static_cast<std::size_t>(result.num_segments));
  for (segment_t& segment : result.segments) read(reader, segment);
  reader.finish();
  if (!reader.ok() || !is_consistent(result)) return std::nullopt;
  return result;
}

SegmentedPoint segmented_point(const segmentation_t& segmentation, std::size_t i) {
  const Record record = read_record(&segmentation.data[i * kPointBytes]);
  SegmentedPoint point;
  for (std::size_t axis = 0; axis < 3; ++axis)
    point.position[static_cast<Eigen::Index>(axis)] =
        segmentation.origin[axis] + segmentation.step * record[axis];
  if (record[3] != segmentation_t::NO_SEGMENT) point.segment = record[3];
  point.is_edge = (record[4] & segmentation_t::EDGE) != 0;
  point.is_support = (record[4] & segmentation_t::SUPPORT) != 0;
  return point;
}

}  // namespace graspd

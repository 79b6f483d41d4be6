// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "service/transport/byte_writer.hpp"
#include "service/transport/handle_list_codec.hpp"
#include "service/transport/wire_layout.hpp"

namespace graspd {
namespace {

void write(const Gripper& gripper, ByteWriter& writer) {
  writer.string(gripper.name);
  writer.float64s({{gripper.aperture_m, gripper.finger_width_m, gripper.finger_thickness_m,
                    gripper.finger_length_m, gripper.grasp_depth_m, gripper.min_gap_m}});
}

void write(const FailureCounts& counts, ByteWriter& writer) {
  writer.count(counts.size() - static_cast<std::size_t>(std::count(counts.begin(), counts.end(), 0)));
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] == 0) continue;
    writer.string(name(static_cast<Failure>(i)));
    writer.int64(counts[i]);
  }
}

void write(const Eigen::Vector3f& v, ByteWriter& writer) {
  writer.float64s({v.data(), 3});
}

void write(const Handle& handle, std::size_t id, ByteWriter& writer) {
  writer.int32(static_cast<std::int32_t>(id));
  writer.int32(handle.segment);
  write(handle.position, writer);
  const Eigen::Quaternionf q = quaternion(handle.rotation);
  writer.float64s({{q.w(), q.x(), q.y(), q.z()}});
  write(roll_pitch_yaw(handle.rotation), writer);
  for (const int axis : {2, 1, 0}) write(handle.rotation.col(axis), writer);  // approach, closing, major
  writer.float64(double{handle.width_m});
  writer.float64s(handle.gap_m);
  writer.float64s(handle.observed_free);
  writer.int32(handle.num_points);
  writer.float64(double{handle.score});
}

}  // namespace

void HandleListMessage::set_latency(double latency_s) {
  std::pmr::vector<std::byte> value;
  ByteWriter(value).float64(latency_s);
  std::copy(value.begin(), value.end(), bytes.begin() + static_cast<std::ptrdiff_t>(latency_at));
}

void encode(const HandleListHeader& header, const Gripper& gripper, const Detection& detection,
            const Eigen::Isometry3f& T_target_cloud, HandleListMessage& message) {
  message.bytes.clear();
  ByteWriter writer(message.bytes);
  writer.uint64(kHandleListFingerprint);
  writer.int64(header.utime);
  writer.int64(header.seq);
  writer.string(header.source_channel);
  writer.string(header.frame_name);
  write(gripper, writer);
  writer.int8(header.status);
  writer.string(header.status_text);
  writer.int64(header.config_revision);
  writer.float64(header.voxel_m);
  writer.int8(header.degraded ? 1 : 0);
  writer.int32(detection.points_in);
  writer.int32(detection.points_used);
  writer.count(detection.segments.size());
  writer.int32(detection.num_candidates);
  write(detection.candidate_failures, writer);
  write(detection.segment_failures(), writer);
  writer.count(header.stages_ms.size());
  for (const auto& [stage, milliseconds] : header.stages_ms) {
    writer.string(stage);
    writer.float64(milliseconds);
  }
  message.latency_at = writer.size();
  writer.float64(header.latency_s);
  writer.count(detection.handles.size());
  for (std::size_t id = 0; id < detection.handles.size(); ++id)
    write(transformed(detection.handles[id], T_target_cloud), id, writer);
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/handle_list_codec.hpp"

#include "service/transport/byte_reader.hpp"
#include "service/transport/encoding.hpp"
#include "service/transport/message_parts.hpp"
#include "service/transport/wire_layout.hpp"

namespace graspd {
namespace {

constexpr std::int32_t kMaxHandles = 100'000;
constexpr std::int32_t kMaxStages = 1000;
constexpr std::size_t kMinStageBytes = 4 + 1 + 8;
constexpr std::size_t kHandleBytes = 2 * 4 + 22 * 8 + 4 + 8;

template <int n>
void copy(const Eigen::Matrix<float, n, 1>& from, double (&to)[n]) {
  for (int i = 0; i < n; ++i) to[i] = static_cast<double>(from[i]);
}

gripper_t wire_gripper(const Gripper& gripper) {
  gripper_t result;
  result.name = gripper.name;
  result.aperture = double{gripper.aperture_m};
  result.finger_width = double{gripper.finger_width_m};
  result.finger_thickness = double{gripper.finger_thickness_m};
  result.finger_length = double{gripper.finger_length_m};
  result.grasp_depth = double{gripper.grasp_depth_m};
  result.min_gap = double{gripper.min_gap_m};
  return result;
}

handle_t wire_handle(const Handle& handle, std::int32_t id) {
  handle_t result;
  result.id = id;
  result.segment_id = handle.segment;
  copy<3>(handle.position, result.position);
  const Eigen::Quaternionf q = quaternion(handle.rotation);
  copy<4>({q.w(), q.x(), q.y(), q.z()}, result.orientation);
  copy<3>(roll_pitch_yaw(handle.rotation), result.rpy);
  copy<3>(handle.rotation.col(2), result.approach);
  copy<3>(handle.rotation.col(1), result.closing_axis);
  copy<3>(handle.rotation.col(0), result.major_axis);
  result.width = double{handle.width_m};
  for (std::size_t side = 0; side < 2; ++side) {
    result.gap[side] = double{handle.gap_m[side]};
    result.observed_free[side] = double{handle.observed_free[side]};
  }
  result.num_points = handle.num_points;
  result.score = double{handle.score};
  return result;
}

void read(ByteReader& reader, gripper_t& gripper) {
  gripper.name = reader.string("gripper.name", kMaxTextLength);
  gripper.aperture = reader.float64("gripper.aperture");
  gripper.finger_width = reader.float64("gripper.finger_width");
  gripper.finger_thickness = reader.float64("gripper.finger_thickness");
  gripper.finger_length = reader.float64("gripper.finger_length");
  gripper.grasp_depth = reader.float64("gripper.grasp_depth");
  gripper.min_gap = reader.float64("gripper.min_gap");
}

void read(ByteReader& reader, stage_time_t& stage) {
  stage.stage = reader.string("stages.stage", kMaxTextLength);
  stage.milliseconds = reader.float64("stages.milliseconds");
}

void read(ByteReader& reader, handle_t& handle) {
  handle.id = reader.int32("handles.id");
  handle.segment_id = reader.int32("handles.segment_id");
  reader.float64s("handles.position", handle.position);
  reader.float64s("handles.orientation", handle.orientation);
  reader.float64s("handles.rpy", handle.rpy);
  reader.float64s("handles.approach", handle.approach);
  reader.float64s("handles.closing_axis", handle.closing_axis);
  reader.float64s("handles.major_axis", handle.major_axis);
  handle.width = reader.float64("handles.width");
  reader.float64s("handles.gap", handle.gap);
  reader.float64s("handles.observed_free", handle.observed_free);
  handle.num_points = reader.int32("handles.num_points");
  handle.score = reader.float64("handles.score");
}

}  // namespace

std::vector<reason_count_t> wire_failures(const FailureCounts& counts) {
  std::vector<reason_count_t> result;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] == 0) continue;
    reason_count_t entry;
    entry.reason = name(static_cast<Failure>(i));
    entry.count = counts[i];
    result.push_back(entry);
  }
  return result;
}

std::int8_t wire_status(DetectionStatus status) {
  switch (status) {
    case DetectionStatus::kOk:
      return handle_list_t::OK;
    case DetectionStatus::kEmptyCloud:
      return handle_list_t::EMPTY_CLOUD;
    case DetectionStatus::kNoFinitePoints:
      return handle_list_t::NO_FINITE_POINTS;
    case DetectionStatus::kNothingInWorkspace:
      return handle_list_t::NOTHING_IN_WORKSPACE;
    case DetectionStatus::kNoHandles:
      return handle_list_t::NO_HANDLES;
  }
  return handle_list_t::FAILED;
}

handle_list_t make_handle_list(const HandleListHeader& header, const Gripper& gripper,
                               const Detection& detection, const Eigen::Isometry3f& T_target_cloud) {
  handle_list_t list{};
  list.utime = header.utime;
  list.seq = header.seq;
  list.source_channel = header.source_channel;
  list.frame_name = header.frame_name;
  list.gripper = wire_gripper(gripper);
  list.status = header.status;
  list.status_text = header.status_text;
  list.config_revision = header.config_revision;
  list.voxel_size = header.voxel_m;
  list.degraded = header.degraded ? 1 : 0;
  list.points_in = detection.points_in;
  list.points_used = detection.points_used;
  list.num_segments = static_cast<std::int32_t>(detection.segments.size());
  list.num_candidates = detection.num_candidates;
  list.candidate_failures = wire_failures(detection.candidate_failures);
  list.num_candidate_failures = static_cast<std::int32_t>(list.candidate_failures.size());
  list.segment_failures = wire_failures(detection.segment_failures());
  list.num_segment_failures = static_cast<std::int32_t>(list.segment_failures.size());
  for (const auto& [stage, milliseconds] : header.stages_ms) {
    stage_time_t entry;
    entry.stage = stage;
    entry.milliseconds = milliseconds;
    list.stages.push_back(entry);
  }
  list.num_stages = static_cast<std::int32_t>(list.stages.size());
  list.latency = header.latency_s;
  for (const Handle& handle : detection.handles) {
    const auto id = static_cast<std::int32_t>(list.handles.size());
    list.handles.push_back(wire_handle(transformed(handle, T_target_cloud), id));
  }
  list.num_handles = static_cast<std::int32_t>(list.handles.size());
  return list;
}

void encode(const handle_list_t& list, std::vector<std::byte>& buffer) {
  require_count("handle_list_t.num_candidate_failures", list.num_candidate_failures,
                list.candidate_failures.size());
  require_count("handle_list_t.num_segment_failures", list.num_segment_failures,
                list.segment_failures.size());
  require_count("handle_list_t.num_stages", list.num_stages, list.stages.size());
  require_count("handle_list_t.num_handles", list.num_handles, list.handles.size());
  encode_message(list, buffer);
}

std::vector<std::byte> encode(const handle_list_t& list) {
  return encoded(list);
}

std::optional<handle_list_t> decode_handle_list(std::span<const std::byte> message) {
  if (fingerprint(message) != kHandleListFingerprint) return std::nullopt;
  ByteReader reader(message.subspan(kFingerprintBytes));
  handle_list_t list;
  list.utime = reader.int64("utime");
  list.seq = reader.int64("seq");
  list.source_channel = reader.string("source_channel", kMaxTextLength);
  list.frame_name = reader.string("frame_name", kMaxTextLength);
  read(reader, list.gripper);
  list.status = reader.int8("status");
  list.status_text = reader.string("status_text", kMaxTextLength);
  list.config_revision = reader.int64("config_revision");
  list.voxel_size = reader.float64("voxel_size");
  list.degraded = reader.int8("degraded");
  list.points_in = reader.int32("points_in");
  list.points_used = reader.int32("points_used");
  list.num_segments = reader.int32("num_segments");
  list.num_candidates = reader.int32("num_candidates");
  list.num_candidate_failures = read_reason_counts(reader, list.candidate_failures);
  list.num_segment_failures = read_reason_counts(reader, list.segment_failures);
  list.num_stages = reader.count("num_stages", kMaxStages, kMinStageBytes);
  list.stages.resize(static_cast<std::size_t>(list.num_stages));
  for (stage_time_t& stage : list.stages) read(reader, stage);
  list.latency = reader.float64("latency");
  list.num_handles = reader.count("num_handles", kMaxHandles, kHandleBytes);
  list.handles.resize(static_cast<std::size_t>(list.num_handles));
  for (handle_t& handle : list.handles) read(reader, handle);
  reader.finish();
  if (!reader.ok()) return std::nullopt;
  return list;
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/detect/file_detection.hpp"

#include <chrono>
#include <span>
#include <utility>

#include "client/common/handle_text.hpp"
#include "client/common/text.hpp"
#include "service/pipeline/detect_handles.hpp"
#include "service/transport/handle_list_codec.hpp"

namespace graspd {
namespace {

using Clock = std::chrono::steady_clock;

double milliseconds(Clock::duration time) {
  return std::chrono::duration<double, std::milli>(time).count();
}

std::string reasons(std::span<const reason_count_t> counts) {
  std::string text;
  for (const reason_count_t& count : counts) {
    text += (text.empty() ? "" : ", ") + count.reason + printed(" %lld", static_cast<long long>(count.count));
  }
  return text.empty() ? "none" : text;
}

}  // namespace

FileDetection detect_in_cloud(const PointCloud& cloud, const std::string& frame_name, std::int64_t seq,
                              const SourceConfig& source) {
  const auto start = Clock::now();
  auto last = start;
  HandleListHeader header;
  header.seq = seq;
  header.frame_name = frame_name;
  const auto on_stage = [&](std::string_view stage) {
    const auto now = Clock::now();
    header.stages_ms.emplace_back(stage, milliseconds(now - last));
    last = now;
  };
  const Gripper& gripper = source.gripper.gripper;
  Detection detection = detect_handles(cloud, gripper, source.detect, on_stage);
  header.voxel_m = double{source.detect.downsample.leaf_size_m};
  header.status = wire_status(detection.status);
  header.status_text = status_name(header.status);
  header.latency_s = 1e-3 * milliseconds(Clock::now() - start);
  const Eigen::Isometry3f T_target_cloud = source.sensor_pose.T_target_cloud();
  FileDetection detected{make_handle_list(header, gripper, detection, T_target_cloud),
                         std::move(detection.segments)};
  for (SegmentReport& segment : detected.segments) segment.centroid = T_target_cloud * segment.centroid;
  return detected;
}

std::string detection_stats(const handle_list_t& list) {
  std::string text =
      list.frame_name + ": " + std::string(status_name(list.status)) +
      printed(", %zu handles, %d of %d points, %d segments, %d candidates", list.handles.size(),
              list.points_used, list.points_in, list.num_segments, list.num_candidates);
  text += "; candidates failed: " + reasons(list.candidate_failures);
  text += "; segments without a handle: " + reasons(list.segment_failures) + "; ms: ";
  for (const stage_time_t& stage : list.stages) text += stage.stage + printed(" %.2f, ", stage.milliseconds);
  return text + printed("total %.2f", 1e3 * list.latency);
}

}  // namespace graspd

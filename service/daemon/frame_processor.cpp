// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/daemon/frame_processor.hpp"

#include <exception>
#include <utility>
#include <variant>

#include "service/pipeline/detect_handles.hpp"
#include "service/transport/cloud_decoder.hpp"
#include "service/transport/segmentation_codec.hpp"

namespace graspd {
namespace {

/// Digits fit into a string without memory of its own.
std::pmr::string with_number(std::string_view before, std::size_t number, std::string_view after) {
  std::pmr::string text(before);
  text += std::to_string(number);
  return text += after;
}

std::pmr::string status_text(const Detection& detection) {
  switch (detection.status) {
    case DetectionStatus::kOk:
      return with_number("", detection.handles.size(), " handles");
    case DetectionStatus::kEmptyCloud:
      return "the cloud has no points";
    case DetectionStatus::kNoFinitePoints:
      return "no point of the cloud is finite";
    case DetectionStatus::kNothingInWorkspace:
      return "no finite point is inside the workspace";
    case DetectionStatus::kNoHandles:
      return with_number("no candidate of ", static_cast<std::size_t>(detection.num_candidates),
                         " can be held");
  }
  return "";
}

/// Times between calls.
class StageTimer {
 public:
  explicit StageTimer(const Clock& clock) : clock_(clock), last_(clock.now()) {}

  void stage_done(std::string_view stage) {
    const Clock::TimePoint now = clock_.now();
    stages_ms.emplace_back(stage, milliseconds(now - last_));
    last_ = now;
  }

  StageTimes stages_ms;

 private:
  const Clock& clock_;
  Clock::TimePoint last_;
};

}  // namespace

FrameProcessor::FrameProcessor(const SourceConfig& source, std::string channel, const DecodeLimits& limits,
                               const Clock& clock, std::int64_t revision)
    : source_(source),
      degraded_detect_(source.degrade.voxel_m > 0 ? source.degraded_detect() : source.detect),
      channel_(std::move(channel)),
      limits_(limits),
      clock_(clock),
      revision_(revision) {}

Answer FrameProcessor::process(const FrameMessage& message, Effort effort,
                               const std::atomic<bool>& cancelled) const {
  try {
    return detect(message, effort, cancelled);
  } catch (const Cancelled&) {
    return drop(message, DropReason::kStopping, "graspd stops");
  } catch (const std::exception& e) {
    return fail(message, e.what());
  } catch (...) {
    return fail(message, "unknown exception");
  }
}

std::optional<Refusal> FrameProcessor::check(std::span<const std::byte> message) const {
  return check_cloud(message, limits_, source_.input);
}

std::optional<Clock::TimePoint> FrameProcessor::deadline(const FrameMessage& message) const {
  if (source_.deadline_ms <= 0) return std::nullopt;
  return message.arrival + std::chrono::milliseconds(source_.deadline_ms);
}

Answer FrameProcessor::detect(const FrameMessage& message, Effort effort,
                              const std::atomic<bool>& cancelled) const {
  StageTimer timer(clock_);
  const auto on_stage = [&](std::string_view stage) {
    timer.stage_done(stage);
    if (cancelled) throw Cancelled{};
  };
  const std::variant<Frame, Refusal> decoded = decode_cloud(message.bytes, limits_, source_.input);
  if (const auto* refusal = std::get_if<Refusal>(&decoded)) return refuse(*refusal, message.arrival);
  on_stage("decode");
  const Frame& frame = std::get<Frame>(decoded);
  const DetectConfig& settings = effort == Effort::kDegraded ? degraded_detect_ : source_.detect;
  const bool with_segments = publishes_segments(message);
  Surfaces surfaces;
  const Detection detection = detect_handles(frame.cloud, source_.gripper.gripper, settings, on_stage,
                                             with_segments ? &surfaces : nullptr);
  HandleListHeader header = list_header({frame.utime, frame.seq, frame.frame_name});
  header.voxel_m = double{settings.downsample.leaf_size_m};
  header.degraded = effort == Effort::kDegraded && source_.degrade.voxel_m > 0;
  header.status = wire_status(detection.status);
  header.status_text = status_text(detection);
  header.stages_ms = std::move(timer.stages_ms);
  Answer answer = make_answer(Outcome::kProcessed, header, detection, message.arrival);
  if (!surfaces.cloud.empty()) {
    answer.segments_channel = source_.segments_channel;
    answer.segmentation =
        encode(make_segmentation(header, detection, surfaces, source_.sensor_pose.T_target_cloud()));
  }
  return answer;
}

bool FrameProcessor::publishes_segments(const FrameMessage& message) const {
  return source_.publish_segments == PublishSegments::kAlways ||
         (source_.publish_segments == PublishSegments::kOnRequest && message.segments_requested);
}

Answer FrameProcessor::drop(const FrameMessage& message, DropReason reason, const std::string& why) const {
  HandleListHeader header = list_header(message.header);
  header.status = handle_list_t::OVERLOADED;
  header.status_text = why;
  Answer answer = make_answer(Outcome::kDropped, header, {}, message.arrival);
  answer.drop = reason;
  return answer;
}

Answer FrameProcessor::fail(const FrameMessage& message, const std::string& why) const {
  HandleListHeader header = list_header(message.header);
  header.status = handle_list_t::FAILED;
  header.status_text = why;
  return make_answer(Outcome::kFailed, header, {}, message.arrival);
}

Answer FrameProcessor::refuse(const Refusal& refusal, Clock::TimePoint arrival) const {
  HandleListHeader header = list_header({refusal.utime, refusal.seq, refusal.frame_name});
  header.status = handle_list_t::REFUSED;
  header.status_text = std::string(name(refusal.reason)) + ": " + refusal.text;
  Answer answer = make_answer(Outcome::kRefused, header, {}, arrival);
  answer.refusal = refusal.reason;
  return answer;
}

HandleListHeader FrameProcessor::list_header(const FrameHeader& header) const {
  HandleListHeader list;
  list.utime = header.utime;
  list.seq = header.seq;
  list.source_channel = channel_;
  list.config_revision = revision_;
  list.voxel_m = double{source_.detect.downsample.leaf_size_m};
  list.frame_name = header.frame_name;
  if (source_.sensor_pose.given()) list.frame_name = source_.sensor_pose.frame_name;
  return list;
}

Answer FrameProcessor::make_answer(Outcome outcome, const HandleListHeader& header,
                                   const Detection& detection, Clock::TimePoint arrival) const {
  Answer answer;
  answer.outcome = outcome;
  answer.arrival = arrival;
  answer.degraded = header.degraded;
  answer.status_text = header.status_text;
  answer.handles_channel = source_.handles_channel;
  encode(header, source_.gripper.gripper, detection, source_.sensor_pose.T_target_cloud(), answer.list);
  return answer;
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/labelled_frames.hpp"

#include <map>
#include <utility>
#include <variant>

#include "client/common/cloud_list.hpp"
#include "client/common/gripper_pose.hpp"
#include "client/common/text.hpp"
#include "client/evaluate/label_decoder.hpp"
#include "client/log/event_log_reader.hpp"
#include "service/transport/cloud_decoder.hpp"
#include "service/transport/handle_list_codec.hpp"
#include "service/transport/wire_layout.hpp"

namespace graspd {
namespace {

using Visit = std::function<bool(LabelledFrame&)>;
using Problem = std::function<void(const std::string&)>;
/// Channel and seq of the cloud that was answered.
using Answers = std::map<std::pair<std::string, std::int64_t>, std::pmr::vector<Handle>>;

Handle handle_of(const handle_t& wire) {
  Handle handle;
  const Eigen::Isometry3d pose = T_frame_gripper(wire);
  handle.position = pose.translation().cast<float>();
  handle.rotation = pose.linear().cast<float>();
  handle.width_m = static_cast<float>(wire.width);
  handle.score = static_cast<float>(wire.score);
  return handle;
}

/// Answers come after their clouds, so that the log is read twice.
Answers read_answers(const std::filesystem::path& log) {
  Answers answers;
  EventLogReader reader(log);
  LoggedEvent event;
  while (reader.next(event)) {
    const auto list = decode_handle_list(event.bytes);
    if (!list) continue;
    auto& handles = answers[{list->source_channel, list->seq}];
    handles.clear();
    for (const handle_t& handle : list->handles) handles.push_back(handle_of(handle));
  }
  return answers;
}

bool is_cloud(const LoggedEvent& event) {
  const auto type = fingerprint(event.bytes);
  return type == kPointCloudFingerprint || type == kDepthImageFingerprint;
}

/// Nothing, and a problem said, where the event is no labelled cloud.
std::optional<LabelledFrame> frame_of(const LoggedEvent& event, const std::filesystem::path& log,
                                      const Problem& problem) {
  auto decoded = decode_cloud(event.bytes, DecodeLimits{});
  LabelledFrame frame;
  if (const auto* refusal = std::get_if<Refusal>(&decoded)) {
    problem(log.string() + ": " + plain_line(event.channel) + ": " + refusal->text);
    return std::nullopt;
  }
  auto& cloud = std::get<Frame>(decoded);
  frame.seq = cloud.seq;
  frame.name = log.filename().string() + '#' + std::to_string(cloud.seq);
  frame.cloud.cloud = std::move(cloud.cloud);
  frame.cloud.label = decode_labels(event.bytes);
  return frame;
}

bool visit_log(const std::filesystem::path& log, const Visit& visit, const Problem& problem) {
  const Answers answers = read_answers(log);
  EventLogReader reader(log);
  LoggedEvent event;
  while (reader.next(event)) {
    if (!is_cloud(event)) continue;
    auto frame = frame_of(event, log, problem);
    if (!frame) continue;
    const auto answer = answers.find({event.channel, *frame->seq});
    if (answer != answers.end()) frame->logged_handles = answer->second;
    if (!visit(*frame)) return false;
  }
  if (reader.skipped_bytes() > 0)
    problem(log.string() + printed(": %lld bytes are damaged or end within an event, and were left out",
                                   static_cast<long long>(reader.skipped_bytes())));
  return true;
}

bool visit_file(const std::filesystem::path& path, const Visit& visit, const Problem& problem) {
  LabelledFrame frame;
  frame.name = path.stem().string();
  try {
    frame.cloud = load_cloud(path);
  } catch (const CloudFileError& error) {
    problem(error.what());
    return true;
  }
  return visit(frame);
}

}  // namespace

void for_each_frame(const std::vector<std::string>& arguments, const Visit& visit, const Problem& problem) {
  for (const std::string& argument : arguments) {
    for (const auto& path : list_cloud_files({argument})) {
      const bool go_on =
          is_event_log(path) ? visit_log(path, visit, problem) : visit_file(path, visit, problem);
      if (!go_on) return;
    }
  }
}

}  // namespace graspd

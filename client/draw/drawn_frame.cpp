// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/draw/drawn_frame.hpp"

#include <optional>
#include <stdexcept>
#include <utility>
#include <variant>

#include "client/common/cloud_colors.hpp"
#include "client/common/cloud_list.hpp"
#include "client/common/handle_text.hpp"
#include "client/common/sealed_message.hpp"
#include "client/common/text.hpp"
#include "client/log/event_log_reader.hpp"
#include "service/pipeline/detect_handles.hpp"
#include "service/transport/cloud_decoder.hpp"
#include "service/transport/handle_list_codec.hpp"
#include "service/transport/segmentation_codec.hpp"
#include "service/transport/wire_layout.hpp"

namespace graspd {
namespace {

/// A frame, and what its log says about it.
struct FoundFrame {
  std::string name;
  LabelledCloud cloud;
  FrameHeader header;
  std::string channel;
  std::optional<handle_list_t> list;
  std::optional<segmentation_t> segmentation;
};

class Search {
 public:
  Search(std::size_t number, const CloudInput& input, std::span<const SealKey> keys,
         std::vector<std::string>& problems)
      : left_(number), input_(input), keys_(keys), problems_(problems) {}

  bool in_file(const std::filesystem::path& path) {
    try {
      LabelledCloud cloud = load_cloud(path);
      if (left_-- > 0) return false;
      found_.name = path.stem().string();
      found_.header.frame_name = found_.name;
      found_.cloud = std::move(cloud);
      return true;
    } catch (const CloudFileError& error) {
      problems_.emplace_back(error.what());
      return false;
    }
  }

  bool in_log(const std::filesystem::path& log) {
    EventLogReader reader(log);
    LoggedEvent event;
    bool is_found = false;
    std::int64_t unopened = 0;
    while (!is_complete() && reader.next(event)) {
      if (!open(event)) {
        ++unopened;
      } else if (!is_found) {
        is_found = take_cloud(event, log);
      } else {
        take_answer(event);
      }
    }
    if (reader.skipped_bytes() > 0)
      problems_.push_back(log.string() + printed(": %lld bytes are damaged, and were left out",
                                                 static_cast<long long>(reader.skipped_bytes())));
    if (unopened > 0)
      problems_.push_back(log.string() +
                          printed(": %lld signed messages were left out: --key FILE opens them",
                                  static_cast<long long>(unopened)));
    return is_found;
  }

  FoundFrame take() { return std::move(found_); }

 private:
  [[nodiscard]] bool is_complete() const { return found_.list && found_.segmentation; }

  /// Puts what a signed message holds in its place; false: no key opens it.
  bool open(LoggedEvent& event) const {
    if (fingerprint(event.bytes) != kSealedFingerprint) return true;
    const auto inside = opened(keys_, event.channel, event.bytes);
    if (inside.data() == event.bytes.data()) return false;
    event.bytes = std::vector<std::byte>(inside.begin(), inside.end());
    return true;
  }

  bool take_cloud(const LoggedEvent& event, const std::filesystem::path& log) {
    const auto type = fingerprint(event.bytes);
    if (type == kHandleListFingerprint || type == kStatusFingerprint || type == kSegmentationFingerprint ||
        type == kControlFingerprint || type == kSegmentationRequestFingerprint || type == kSealedFingerprint)
      return false;
    auto decoded = decode_cloud(event.bytes, DecodeLimits{}, input_);
    if (const auto* refusal = std::get_if<Refusal>(&decoded)) {
      if (refusal->reason != RefusalReason::kUnknownType)
        problems_.push_back(log.string() + ": " + plain_line(event.channel) + ": " + refusal->text);
      return false;
    }
    if (left_-- > 0) return false;
    auto& frame = std::get<Frame>(decoded);
    found_.header = {frame.utime, frame.seq, frame.frame_name};
    found_.channel = event.channel;
    found_.name = log.filename().string() + '#' + std::to_string(frame.seq);
    found_.cloud.cloud = std::move(frame.cloud);
    found_.cloud.rgb = cloud_colors(event.bytes, DecodeLimits{});
    return true;
  }

  template <class Message>
  [[nodiscard]] bool is_of_found(const Message& message) const {
    return message.source_channel == found_.channel && message.seq == found_.header.seq &&
           message.utime == found_.header.utime;
  }

  void take_answer(const LoggedEvent& event) {
    if (auto list = decode_handle_list(event.bytes); list && !found_.list && is_of_found(*list))
      found_.list = std::move(list);
    if (auto seen = decode_segmentation(event.bytes); seen && !found_.segmentation && is_of_found(*seen))
      found_.segmentation = std::move(seen);
  }

  std::size_t left_;
  const CloudInput& input_;
  std::span<const SealKey> keys_;
  std::vector<std::string>& problems_;
  FoundFrame found_;
};

/// What the log did not say.
void detect(FoundFrame& found, const SourceConfig& source) {
  Surfaces surfaces;
  const Gripper& gripper = source.gripper.gripper;
  const Detection detection = detect_handles(found.cloud.cloud, gripper, source.detect, {}, &surfaces);
  HandleListHeader header;
  header.utime = found.header.utime;
  header.seq = found.header.seq;
  header.frame_name = found.header.frame_name;
  header.voxel_m = double{source.detect.downsample.leaf_size_m};
  header.status = wire_status(detection.status);
  header.status_text = status_name(header.status);
  const Eigen::Isometry3f T = source.sensor_pose.T_target_cloud();
  if (!found.list) found.list = make_handle_list(header, gripper, detection, T);
  if (!found.segmentation && !surfaces.cloud.empty())
    found.segmentation = make_segmentation(header, detection, surfaces, T);
}

}  // namespace

PictureFrame find_drawn_frame(const std::vector<std::string>& arguments, std::size_t number,
                              const SourceConfig& source, std::span<const SealKey> keys,
                              std::vector<std::string>& problems) {
  Search search(number, source.input, keys, problems);
  bool is_found = false;
  for (const auto& path : list_cloud_files(arguments)) {
    is_found = is_event_log(path) ? search.in_log(path) : search.in_file(path);
    if (is_found) break;
  }
  if (!is_found)
    throw std::runtime_error("there is no frame " + std::to_string(number) + " that can be drawn");
  FoundFrame found = search.take();
  if (!found.list || !found.segmentation) detect(found, source);
  PictureFrame frame;
  frame.title = found.name;
  frame.T_frame_cloud = source.sensor_pose.T_target_cloud();
  frame.cloud = std::move(found.cloud);
  frame.list = std::move(*found.list);
  if (found.segmentation) frame.segmentation = std::move(*found.segmentation);
  return frame;
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/compare/worst_pictures.hpp"

#include <map>
#include <utility>
#include <variant>

#include "client/common/replace_file.hpp"
#include "client/common/sealed_message.hpp"
#include "client/common/text.hpp"
#include "client/draw/picture.hpp"
#include "client/log/event_log_reader.hpp"
#include "service/transport/cloud_decoder.hpp"

namespace graspd {
namespace {

std::string draw(const ComparedFrame& frame, bool after, const Frame& cloud, const SourceConfig& source,
                 const std::filesystem::path& folder) {
  PictureFrame picture;
  picture.title =
      printed("frame %lld, %s", static_cast<long long>(frame.difference.frame), after ? "after" : "before");
  picture.cloud.cloud = cloud.cloud;
  picture.T_frame_cloud = source.sensor_pose.T_target_cloud();
  picture.list = after ? frame.after : frame.before;
  PictureOptions options;
  options.color = PictureColor::kDepth;
  options.width = 640;
  options.height = 480;
  const std::string name = printed("frame-%06lld-%s.png", static_cast<long long>(frame.difference.frame),
                                   after ? "after" : "before");
  replace_file(folder / name, encode_png(draw_picture(picture, options)));
  return name;
}

}  // namespace

std::vector<FramePictures> draw_worst(const RunComparison& comparison,
                                      const std::vector<std::filesystem::path>& clouds,
                                      const ServiceConfig& config, const std::filesystem::path& folder) {
  std::vector<FramePictures> pictures(comparison.worst.size());
  std::map<FrameKey, std::size_t> wanted;
  for (std::size_t i = 0; i < comparison.worst.size(); ++i)
    wanted.emplace(comparison.worst[i].difference.key, i);
  std::map<FrameKey, std::int64_t> repeats;
  const std::vector<SealKey> keys = seal_keys_of(config.authentication.key_file);
  const DecodeLimits& limits = config.limits.decode;
  EventHead head;
  std::vector<std::byte> bytes;
  for (const auto& log : clouds) {
    EventLogReader reader(log);
    while (!wanted.empty() && reader.next_head(head)) {
      const std::size_t source = first_source(config, head.channel);
      if (source == config.sources.size()) continue;
      reader.read_message(bytes);
      const auto message = opened(keys, head.channel, bytes);
      const FrameHeader header = peek_header(message, limits);
      FrameKey key{head.channel, header.utime, header.seq, 0};
      key.repeat = repeats[key]++;
      const auto found = wanted.find(key);
      if (found == wanted.end()) continue;
      const auto decoded = decode_cloud(message, limits, config.sources[source].input);
      if (const auto* frame = std::get_if<Frame>(&decoded); frame != nullptr && !frame->cloud.empty()) {
        const ComparedFrame& compared = comparison.worst[found->second];
        pictures[found->second] = {draw(compared, false, *frame, config.sources[source], folder),
                                   draw(compared, true, *frame, config.sources[source], folder)};
      }
      wanted.erase(found);
    }
  }
  return pictures;
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/view/frame_matcher.hpp"

#include <algorithm>
#include <utility>

namespace graspd {
namespace {

std::size_t bytes_of(const MatchedFrame& frame) {
  return frame.cloud.size() + frame.segmentation.size();
}

bool within(const std::optional<std::int64_t>& time_us, std::int64_t now_us, std::int64_t span_us) {
  return time_us && now_us - *time_us <= span_us;
}

}  // namespace

FrameMatcher::Channel* FrameMatcher::find(const std::string& channel) {
  const auto found = channels_.find(channel);
  if (found != channels_.end()) return &found->second;
  return channels_.size() < kMostChannels ? &channels_[channel] : nullptr;
}

MatchedFrame* FrameMatcher::find(Channel& channel, std::int64_t utime, std::int64_t seq) {
  // The newest first: a publisher that starts again repeats its numbers.
  const auto found =
      std::find_if(channel.waiting.rbegin(), channel.waiting.rend(),
                   [&](const MatchedFrame& f) { return f.header.utime == utime && f.header.seq == seq; });
  return found == channel.waiting.rend() ? nullptr : &*found;
}

void FrameMatcher::drop_oldest(Channel& channel) {
  bytes_ -= bytes_of(channel.waiting.front());
  channel.waiting.pop_front();
}

/// Older ones of the channel go: the picture never runs backwards.
void FrameMatcher::give(Channel& channel, const MatchedFrame* frame) {
  while (&channel.waiting.front() != frame) drop_oldest(channel);
  channel.last_given_us = frame->arrived_us;
  MatchedFrame given = std::move(channel.waiting.front());
  bytes_ -= bytes_of(given);
  channel.waiting.pop_front();
  ready_(std::move(given));
}

void FrameMatcher::give_if_whole(Channel& channel, MatchedFrame* frame, std::int64_t now_us) {
  if (frame == nullptr || !frame->list) return;
  // One that was not worked on is passed over for the next.
  if (frame->list->status == handle_list_t::OVERLOADED) return;
  const bool more_to_come =
      frame->segmentation.empty() &&
      (expected_ || within(channel.last_segmentation_us, now_us, kSilence_us)) &&
      (frame->list->status == handle_list_t::OK || frame->list->status == handle_list_t::NO_HANDLES);
  if (!more_to_come) give(channel, frame);
}

void FrameMatcher::add_cloud(const std::string& name, const FrameHeader& header,
                             std::span<const std::byte> message, std::int64_t now_us) {
  Channel* channel = find(name);
  if (channel == nullptr || message.size() > kMostBytes) return;
  if (channel->first_cloud_us == 0) channel->first_cloud_us = now_us;
  MatchedFrame& frame = channel->waiting.emplace_back();
  frame.channel = name;
  frame.header = header;
  frame.cloud.assign(message.begin(), message.end());
  frame.arrived_us = now_us;
  bytes_ += bytes_of(frame);
  while (channel->waiting.size() > kMostClouds) drop_oldest(*channel);
  while (bytes_ > kMostBytes) {
    const auto most = std::max_element(channels_.begin(), channels_.end(), [](const auto& a, const auto& b) {
      return a.second.waiting.size() < b.second.waiting.size();
    });
    drop_oldest(most->second);
  }
}

void FrameMatcher::add_list(const handle_list_t& list, std::int64_t now_us) {
  Channel* channel = find(list.source_channel);
  if (channel == nullptr) return;
  channel->last_list_us = now_us;
  MatchedFrame* frame = find(*channel, list.utime, list.seq);
  if (frame == nullptr) return;
  frame->list = list;
  frame->answered_us = now_us;
  give_if_whole(*channel, frame, now_us);
}

void FrameMatcher::add_segmentation(const std::string& name, std::int64_t utime, std::int64_t seq,
                                    std::span<const std::byte> message, std::int64_t now_us) {
  Channel* channel = find(name);
  if (channel == nullptr || message.size() > kMostBytes - bytes_) return;
  channel->last_segmentation_us = now_us;
  MatchedFrame* frame = find(*channel, utime, seq);
  if (frame == nullptr || !frame->segmentation.empty()) return;
  frame->segmentation.assign(message.begin(), message.end());
  bytes_ += message.size();
  give_if_whole(*channel, frame, now_us);
}

void FrameMatcher::look(std::int64_t now_us) {
  for (auto& [name, channel] : channels_) {
    if (channel.waiting.empty()) continue;
    const auto late = std::find_if(channel.waiting.rbegin(), channel.waiting.rend(),
                                   [now_us, last_given_us = channel.last_given_us](const MatchedFrame& f) {
                                     if (!f.list) return false;
                                     const bool passed_over = f.list->status == handle_list_t::OVERLOADED;
                                     return passed_over ? f.arrived_us - last_given_us > kSilence_us
                                                        : now_us - f.answered_us > kSegmentationWait_us;
                                   });
    if (late != channel.waiting.rend())
      give(channel, &*late);
    else if (!within(channel.last_list_us, now_us, kSilence_us) &&
             now_us - channel.first_cloud_us > kFirstWait_us)
      give(channel, &channel.waiting.back());
  }
}

void FrameMatcher::clear() {
  channels_.clear();
  bytes_ = 0;
}

}  // namespace graspd

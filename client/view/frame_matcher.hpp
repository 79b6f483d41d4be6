// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Puts together what belongs to one frame: the cloud, its handle list, its segmentation.
#pragma once
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "graspd/handle_list_t.hpp"
#include "service/transport/frame.hpp"

namespace graspd {

/// A cloud as it came, and what was said about it.
struct MatchedFrame {
  std::string channel;
  FrameHeader header;
  std::vector<std::byte> cloud;  ///< the message
  std::optional<handle_list_t> list;
  std::vector<std::byte> segmentation;  ///< the message; empty: none came
  std::int64_t arrived_us = 0;
  std::int64_t answered_us = 0;  ///< when the list came
};

/// Times are microseconds of one clock, live or a log's. Keeps a few clouds a channel and a bounded number of
/// bytes; a cloud is given away at most once, and never after a newer one of its channel.
class FrameMatcher {
 public:
  using Ready = std::function<void(MatchedFrame)>;
  static constexpr std::size_t kMostClouds = 16;        ///< waiting, of a channel
  static constexpr std::size_t kMostChannels = 64;      ///< further ones are ignored
  static constexpr std::size_t kMostBytes = 512 << 20;  ///< of all that waits
  static constexpr std::int64_t kSegmentationWait_us = 400'000;
  static constexpr std::int64_t kFirstWait_us = 500'000;  ///< for the answer to a channel's first cloud
  static constexpr std::int64_t kSilence_us = 2'000'000;  ///< nobody answers: clouds are shown alone

  explicit FrameMatcher(Ready ready) : ready_(std::move(ready)) {}

  void add_cloud(const std::string& channel, const FrameHeader& header, std::span<const std::byte> message,
                 std::int64_t now_us);
  void add_list(const handle_list_t& list, std::int64_t now_us);
  void add_segmentation(const std::string& channel, std::int64_t utime, std::int64_t seq,
                        std::span<const std::byte> message, std::int64_t now_us);
  /// To be called now and then: gives away what waits in vain.
  void look(std::int64_t now_us);
  /// A segmentation is waited for from the first frame on.
  void expect_segmentations() { expected_ = true; }
  /// Forgets what waits: the clock has jumped.
  void clear();

 private:
  struct Channel {
    std::deque<MatchedFrame> waiting;  // oldest first
    std::int64_t first_cloud_us = 0;
    std::int64_t last_given_us = 0;  // when it had arrived
    std::optional<std::int64_t> last_list_us;
    std::optional<std::int64_t> last_segmentation_us;
  };

  [[nodiscard]] Channel* find(const std::string& channel);
  [[nodiscard]] static MatchedFrame* find(Channel& channel, std::int64_t utime, std::int64_t seq);
  void give(Channel& channel, const MatchedFrame* frame);
  void drop_oldest(Channel& channel);
  void give_if_whole(Channel& channel, MatchedFrame* frame, std::int64_t now_us);

  Ready ready_;
  std::map<std::string, Channel, std::less<>> channels_;
  std::size_t bytes_ = 0;
  bool expected_ = false;
};

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Which channels are served, by which source's settings.
#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "service/config/service_config.hpp"
#include "service/daemon/stream.hpp"
#include "service/runtime/clock.hpp"
#include "service/runtime/frame_queue.hpp"
#include "service/runtime/log.hpp"

namespace graspd {

/// Belongs to the LCM thread; queue, clock and log must outlive it.
class StreamTable {
 public:
  StreamTable(FrameQueue<Job>& queue, const Clock& clock, Log& log, Stream::Publish publish);

  /// From now on this configuration holds. Channels that it does not know any more are forgotten. The jobs
  /// that lose their place with that are returned; those in work go on.
  [[nodiscard]] std::vector<Job> configure(std::shared_ptr<const ServiceConfig> config,
                                           std::int64_t revision);

  /// The channel's stream, made when it is not there yet. Nothing where the messages of this subscription are
  /// another's on that channel, the daemon's own, or of a channel too many.
  [[nodiscard]] std::shared_ptr<Stream> find(const std::string& subscription, std::string_view channel);

  [[nodiscard]] bool knows(std::string_view channel) const { return by_channel_.contains(channel); }
  /// Counts a message that is not looked at.
  void ignore(std::string_view channel, const std::string& reason);

  /// In order of their first message.
  [[nodiscard]] const std::vector<std::shared_ptr<Stream>>& streams() const { return streams_; }
  /// Messages that were not looked at, channels too many among them.
  [[nodiscard]] std::int64_t ignored() const { return ignored_; }

 private:
  std::shared_ptr<Stream> add(std::size_t source, const std::string& channel);
  std::vector<Job> set_up(Stream& stream, std::size_t source);
  std::vector<Job> forget_unknown();

  FrameQueue<Job>& queue_;
  const Clock& clock_;
  Log& log_;
  const Stream::Publish publish_;
  std::shared_ptr<const ServiceConfig> config_;
  std::int64_t revision_ = 0;
  std::vector<std::shared_ptr<Stream>> streams_;
  std::map<std::string, std::shared_ptr<Stream>, std::less<>> by_channel_;
  std::vector<std::size_t> free_queues_;
  std::int64_t ignored_ = 0;
};

}  // namespace graspd

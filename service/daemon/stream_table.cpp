// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/daemon/stream_table.hpp"

#include <utility>

namespace graspd {
namespace {

LoadLimits load_limits(const DegradeConfig& degrade) {
  return {degrade.voxel_m > 0, 1e-3 * degrade.above_ms, 1e-3 * degrade.below_ms, degrade.above_drop_share,
          degrade.hold_s};
}

}  // namespace

StreamTable::StreamTable(FrameQueue<Job>& queue, const Clock& clock, Log& log, Stream::Publish publish)
    : queue_(queue), clock_(clock), log_(log), publish_(std::move(publish)) {}

std::vector<Job> StreamTable::configure(std::shared_ptr<const ServiceConfig> config, std::int64_t revision) {
  config_ = std::move(config);
  revision_ = revision;
  std::vector<Job> dropped = forget_unknown();
  for (const auto& stream : streams_)
    for (Job& job : set_up(*stream, first_source(*config_, stream->channel)))
      dropped.push_back(std::move(job));
  for (std::size_t i = 0; i < config_->sources.size(); ++i) {
    const std::string& channel = config_->sources[i].channel;
    // Seen in the status from the start, message or none.
    if (is_plain_channel(channel) && !by_channel_.contains(channel))
      add(first_source(*config_, channel), channel);
  }
  return dropped;
}

std::shared_ptr<Stream> StreamTable::find(const std::string& subscription, std::string_view channel) {
  if (const auto found = by_channel_.find(channel); found != by_channel_.end())
    return found->second->subscription == subscription ? found->second : nullptr;
  const std::string name(channel);
  if (is_own_channel(*config_, name)) return nullptr;
  const std::size_t source = first_source(*config_, name);
  const auto& sources = config_->sources;
  // Another source's subscription brings the same message.
  if (source == sources.size() || sources[source].channel != subscription) return nullptr;
  if (streams_.size() >= static_cast<std::size_t>(config_->limits.max_sources)) {
    ignore(name, "more than limits.max_sources, " + std::to_string(config_->limits.max_sources));
    return nullptr;
  }
  log_.info("channel_found", {{"source", sources[source].name}, {"channel", name}});
  return add(source, name);
}

void StreamTable::ignore(std::string_view channel, const std::string& reason) {
  ++ignored_;
  log_.warning("channel_ignored", {{"channel", std::string(channel)}, {"reason", reason}});
}

std::shared_ptr<Stream> StreamTable::add(std::size_t source, const std::string& channel) {
  std::size_t queue = 0;
  if (free_queues_.empty()) {
    queue = queue_.add_source(1, 1);
  } else {
    queue = free_queues_.back();
    free_queues_.pop_back();
  }
  auto stream = std::make_shared<Stream>(channel, queue, publish_);
  (void)set_up(*stream, source);  // nothing waits yet
  streams_.push_back(stream);
  by_channel_.emplace(channel, stream);
  return stream;
}

std::vector<Job> StreamTable::set_up(Stream& stream, std::size_t source) {
  const SourceConfig& settings = config_->sources[source];
  stream.source = source;
  stream.subscription = settings.channel;
  stream.processor = std::make_shared<const FrameProcessor>(settings, stream.channel, config_->limits.decode,
                                                            clock_, revision_);
  stream.load.set_limits(load_limits(settings.degrade));
  const bool all = settings.policy == FramePolicy::kAll;
  return queue_.configure(stream.queue, all ? static_cast<std::size_t>(settings.queue_length) : 1,
                          all ? static_cast<std::size_t>(config_->workers) : 1);
}

std::vector<Job> StreamTable::forget_unknown() {
  std::vector<Job> dropped;
  std::erase_if(streams_, [&](const std::shared_ptr<Stream>& stream) {
    if (first_source(*config_, stream->channel) < config_->sources.size()) return false;
    log_.info("channel_forgotten", {{"channel", stream->channel}});
    while (auto job = queue_.drop_oldest(stream->queue)) dropped.push_back(std::move(*job));
    free_queues_.push_back(stream->queue);
    by_channel_.erase(stream->channel);
    return true;
  });
  return dropped;
}

}  // namespace graspd

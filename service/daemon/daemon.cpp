// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/daemon/daemon.hpp"

#include <algorithm>
#include <new>
#include <thread>
#include <utility>

#include "service/transport/cloud_decoder.hpp"
#include "service/transport/status_codec.hpp"

namespace graspd {
namespace {

using namespace std::chrono_literals;
constexpr auto kStatusPeriod = 1s;
constexpr auto kLongestWait = 50ms;  // a signal is seen after that at the latest
constexpr auto kFinishLimit =
    1200ms;  // with kCancelLimit less than the two seconds that a supervisor is promised
constexpr auto kCancelLimit = 400ms;
constexpr auto kPublishLimit = 100ms;

}  // namespace

int threads_a_frame(const ServiceConfig& config) {
  return config.threads > 0 ? config.threads
                            : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

Daemon::Daemon(ServiceConfig config, LcmBus& bus, const Clock& clock, Log& log)
    : config_(std::move(config)),
      bus_(bus),
      clock_(clock),
      log_(log),
      helpers_(tbb::global_control::max_allowed_parallelism,
               static_cast<std::size_t>(threads_a_frame(config_))),
      arena_(threads_a_frame(config_) - 1 + config_.workers, static_cast<unsigned>(config_.workers)),
      health_(clock),
      authentication_(config_),
      next_status_(clock.now()),
      workers_(queue_, static_cast<std::size_t>(config_.workers), [this](Job job) { work(std::move(job)); }) {
  subscribe();
}

void Daemon::subscribe() {
  for (std::size_t i = 0; i < config_.sources.size(); ++i) {
    const std::string& channel = config_.sources[i].channel;
    // Seen in the status from the start, message or none.
    if (is_plain_channel(channel) && !stream_of_channel_.contains(channel)) add_stream(i, channel);
    bus_.subscribe(channel, [this, i](const Packet& packet) { on_packet(i, packet); });
  }
}

LcmBus::Wait Daemon::step() {
  const auto until_status = std::chrono::ceil<std::chrono::milliseconds>(next_status_ - clock_.now());
  const auto result = bus_.wait(std::clamp<std::chrono::milliseconds>(until_status, 0ms, kLongestWait));
  const Clock::TimePoint now = clock_.now();
  if (now >= next_status_) {
    publish_status(status_t::RUNNING);
    // After a pause (a suspended machine) one status, not one for each second of it.
    next_status_ = std::max(next_status_ + kStatusPeriod, now);
  }
  return result;
}

bool Daemon::stop() {
  stopped_ = true;
  queue_.close();
  const auto drop_all = [this] {
    cancelled_ = true;
    for (const auto& waiting : queue_.drop_waiting()) drop(waiting.item, "graspd stops");
  };
  if (config_.on_stop == StopPolicy::kDrop) drop_all();
  bool finished = queue_.wait_idle(kFinishLimit);
  if (!finished) {
    drop_all();
    finished = queue_.wait_idle(kCancelLimit);
  }
  if (!finished) {
    answer_for_workers();
    finished = queue_.wait_idle(kPublishLimit);  // one may be publishing what was just released
  }
  publish_status(status_t::STOPPING);
  return finished;
}

void Daemon::on_packet(std::size_t source, const Packet& packet) {
  if (stopped_) return;
  if (Stream* stream = stream_for(source, packet)) take(*stream, packet);
}

Stream* Daemon::stream_for(std::size_t source, const Packet& packet) {
  const std::string_view channel = packet.channel;
  if (const auto found = stream_of_channel_.find(channel); found != stream_of_channel_.end())
    return found->second->source == source ? found->second : nullptr;
  const std::string name(channel);
  if (is_own_channel(name)) return nullptr;
  for (std::size_t i = 0; i < source; ++i) {
    if (matches_channel(config_.sources[i].channel, name)) return nullptr;  // that source's handler takes it
  }
  if (!authentication_.admits(packet)) {
    ++ignored_;
    log_.warning("channel_ignored", {{"channel", name}, {"reason", "not signed by us"}});
    return nullptr;
  }
  if (streams_.size() >= static_cast<std::size_t>(config_.limits.max_sources)) {
    ++ignored_;
    log_.warning("channel_ignored", {{"channel", name}, {"max_sources", config_.limits.max_sources}});
    return nullptr;
  }
  log_.info("channel_found", {{"source", config_.sources[source].name}, {"channel", name}});
  return &add_stream(source, name);
}

Stream& Daemon::add_stream(std::size_t source, const std::string& channel) {
  const SourceConfig& settings = config_.sources[source];
  const bool all = settings.policy == FramePolicy::kAll;
  const std::size_t queue = queue_.add_source(all ? static_cast<std::size_t>(settings.queue_length) : 1,
                                              all ? static_cast<std::size_t>(config_.workers) : 1);
  streams_.push_back(std::make_unique<Stream>(
      source, channel, queue, FrameProcessor(settings, channel, config_.limits.decode, clock_),
      [this](Stream& stream, Answer answer) { publish(stream, std::move(answer)); }));
  stream_of_channel_.emplace(channel, streams_.back().get());
  return *streams_.back();
}

void Daemon::take(Stream& stream, const Packet& packet) {
  const DecodeLimits& limits = config_.limits.decode;
  const auto opened = authentication_.open(packet, clock_.wall_utime());
  const auto* bytes = std::get_if<std::span<const std::byte>>(&opened);
  const FrameHeader header = bytes != nullptr ? peek_header(*bytes, limits) : FrameHeader{};
  Job job{&stream, stream.gate.take_ticket(), {header, {}, arrival_of(packet)}};
  stream.health.received(job.message.header.seq);
  // Here already, so that what cannot be used never takes the place of a frame that can.
  const auto refusal = bytes != nullptr ? check_cloud(*bytes, limits) : std::get<Refusal>(opened);
  if (refusal) {
    stream.gate.release(job.ticket, stream.processor.refuse(*refusal, job.message.arrival));
    return;
  }
  try {
    job.message.bytes.assign(bytes->begin(), bytes->end());
  } catch (const std::bad_alloc&) {
    stream.gate.release(job.ticket, stream.processor.fail(job.message, "out of memory"));
    return;
  }
  if (const auto dropped = queue_.push(stream.queue, std::move(job)))
    drop(*dropped, "a newer frame came first");
}

void Daemon::work(Job job) {
  {
    const std::lock_guard lock(in_work_mutex_);
    in_work_.insert(&job);
  }
  Answer answer;
  // Isolated: while this frame waits for its helpers its worker must not begin another one.
  arena_.execute([&] {
    tbb::this_task_arena::isolate([&] { answer = job.stream->processor.process(job.message, cancelled_); });
  });
  {
    const std::lock_guard lock(in_work_mutex_);
    in_work_.erase(&job);
  }
  job.stream->gate.release(job.ticket, std::move(answer));
}

void Daemon::answer_for_workers() {
  const std::lock_guard lock(in_work_mutex_);
  for (const Job* job : in_work_) drop(*job, "graspd stops");
}

void Daemon::drop(const Job& job, const std::string& why) {
  job.stream->gate.release(job.ticket, job.stream->processor.drop(job.message, why));
}

void Daemon::publish(Stream& stream, Answer answer) {
  const double latency_s = seconds(clock_.now() - answer.arrival);
  answer.list.latency = latency_s;
  const SourceConfig& source = config_.sources[stream.source];
  if (answer.outcome == Outcome::kRefused)
    log_.warning("frame_refused", {{"channel", stream.channel}, {"reason", answer.list.status_text}});
  if (answer.outcome == Outcome::kFailed)
    log_.error("frame_failed", {{"channel", stream.channel}, {"reason", answer.list.status_text}});
  // Counted first: whoever has the answer finds it in the next status.
  stream.health.answered(answer, latency_s);
  if (!bus_.publish(source.handles_channel, encode(answer.list)))
    log_.error("publish_failed", {{"channel", source.handles_channel}, {"handles", answer.list.num_handles}});
}

void Daemon::publish_status(std::int8_t state) {
  std::vector<source_status_t> sources;
  for (std::size_t i = 0; i < config_.sources.size(); ++i) {
    bool found = false;
    for (const auto& stream : streams_) {
      if (stream->source != i) continue;
      sources.push_back(stream->health.snapshot(clock_.now()));
      sources.back().name = config_.sources[i].name;
      sources.back().channel = stream->channel;
      found = true;
    }
    if (found) continue;
    // A regular expression that nothing has matched yet.
    sources.push_back(ChannelHealth().snapshot(clock_.now()));
    sources.back().name = config_.sources[i].name;
    sources.back().channel = config_.sources[i].channel;
  }
  status_t status = health_.snapshot(state, std::move(sources));
  status.num_workers = config_.workers;
  status.ignored = ignored_;
  if (!bus_.publish(config_.lcm.status_channel, encode(status)))
    log_.error("publish_failed", {{"channel", config_.lcm.status_channel}});
}

bool Daemon::is_own_channel(const std::string& channel) const {
  return channel == config_.lcm.status_channel ||
         std::any_of(config_.sources.begin(), config_.sources.end(),
                     [&](const SourceConfig& source) { return source.handles_channel == channel; });
}

Clock::TimePoint Daemon::arrival_of(const Packet& packet) const {
  // LCM stamps messages by the wall clock before they wait in its queue. A wait that long is a log's time or
  // a jump.
  constexpr std::int64_t kLongestQueue_us = 10'000'000;
  const std::int64_t waited_us = clock_.wall_utime() - packet.recv_utime;
  const bool plausible = waited_us >= 0 && waited_us <= kLongestQueue_us;
  return clock_.now() - std::chrono::microseconds(plausible ? waited_us : 0);
}

}  // namespace graspd

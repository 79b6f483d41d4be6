// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/daemon/daemon.hpp"

#include <algorithm>
#include <exception>
#include <new>
#include <thread>
#include <utility>

#include "service/transport/cloud_decoder.hpp"

namespace graspd {
namespace {

using namespace std::chrono_literals;
constexpr auto kStatusPeriod = 1s;
constexpr auto kLongestWait = 50ms;  // a signal is seen after that at the latest
constexpr auto kFinishLimit =
    1200ms;  // with kCancelLimit less than the two seconds that a supervisor is promised
constexpr auto kCancelLimit = 400ms;
constexpr auto kPublishLimit = 100ms;
// Many answers may wait for one that takes long; these are for people to see, and larger than all the rest.
constexpr std::size_t kMostWaitingSegmentations = 8;

std::string whole_ms(Clock::TimePoint::duration time) {
  return std::to_string(std::chrono::duration_cast<std::chrono::milliseconds>(time).count()) + " ms";
}

/// What the daemon is given, for want of anything to read.
ConfigControl::Load or_unchanged(ConfigControl::Load load, const ServiceConfig& config) {
  if (load) return load;
  return [config](const std::string&) { return config; };
}

}  // namespace

int threads_a_frame(const ServiceConfig& config) {
  return config.threads > 0 ? config.threads
                            : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

Daemon::Daemon(ServiceConfig config, Bus& bus, const Clock& clock, Log& log, ConfigControl::Load load)
    : bus_(bus),
      clock_(clock),
      log_(log),
      config_(std::make_shared<const ServiceConfig>(std::move(config))),
      control_(or_unchanged(std::move(load), *config_)),
      most_threads_(threads_a_frame(*config_)),
      helpers_(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(most_threads_)),
      threads_(most_threads_),
      arena_(most_threads_ - 1 + config_->workers, static_cast<unsigned>(config_->workers)),
      health_(clock),
      next_status_(clock.now()),
      table_(queue_, clock, log,
             [this](Stream& stream, Answer answer) { publish(stream, std::move(answer)); }),
      workers_(queue_, static_cast<std::size_t>(config_->workers),
               [this](Job job) { work(std::move(job)); }) {
  adopt(config_, control_.revision());
}

Bus::Wait Daemon::step() {
  const auto until_status = std::chrono::ceil<std::chrono::milliseconds>(next_status_ - clock_.now());
  const auto result = bus_.wait(std::clamp<std::chrono::milliseconds>(until_status, 0ms, kLongestWait));
  look_at_clock();
  look_at_cores();
  obey_controls();
  watch_work();
  const Clock::TimePoint now = clock_.now();
  if (now >= next_status_) {
    publish_status(num_stuck_ > 0 ? status_t::STUCK : status_t::RUNNING);
    // After a pause (a suspended machine) one status, not one for each second of it.
    next_status_ = std::max(next_status_ + kStatusPeriod, now);
  }
  return result;
}

bool Daemon::stop() {
  stopped_ = true;
  queue_.close();
  const auto drop_one = [](const Job& job) { drop(job, DropReason::kStopping, "graspd stops"); };
  const auto drop_all = [&] {
    work_watch_.cancel_all();
    for (const auto& waiting : queue_.drop_waiting()) drop_one(waiting.item);
  };
  if (config_->on_stop == StopPolicy::kDrop) drop_all();
  bool finished = queue_.wait_idle(kFinishLimit);
  if (!finished) {
    drop_all();
    finished = queue_.wait_idle(kCancelLimit);
  }
  if (!finished) {
    work_watch_.give_up_all(drop_one);
    finished = queue_.wait_idle(kPublishLimit);  // one may be publishing what was just released
  }
  publish_status(status_t::STOPPING);
  return finished;
}

void Daemon::on_packet(const std::string& subscription, const Packet& packet) {
  if (stopped_ || subscription == config_->lcm.status_channel) return;
  if (subscription == config_->lcm.control_channel) {
    on_control(packet);
  } else if (subscription == config_->lcm.request_channel) {
    on_request(packet);
  } else if (!table_.knows(packet.channel) && !authentication_.admits(packet)) {
    table_.ignore(packet.channel, "not signed with a key of ours");
  } else if (const auto stream = table_.find(subscription, packet.channel)) {
    take(stream, packet);
  }
}

void Daemon::take(const std::shared_ptr<Stream>& stream, const Packet& packet) {
  hold_answers_within_limit(*stream);
  const DecodeLimits& limits = config_->limits.decode;
  const auto opened = authentication_.open(packet, clock_.wall_utime());
  const auto* bytes = std::get_if<std::span<const std::byte>>(&opened);
  const FrameHeader header = bytes != nullptr ? peek_header(*bytes, limits) : FrameHeader{};
  Job job{stream, stream->processor, stream->gate.take_ticket(), {header, {}, arrival_of(packet)}};
  job.message.segments_requested = requests_.wants(packet.channel, clock_.now());
  stream->health.received(job.message.header.seq, clock_.now());
  // Here already, so that what cannot be used never takes the place of a frame that can.
  const auto refusal = bytes != nullptr ? job.processor->check(*bytes) : std::get<Refusal>(opened);
  if (refusal) {
    stream->gate.release(job.ticket, job.processor->refuse(*refusal, job.message.arrival));
    return;
  }
  auto lease = take_memory(*stream, bytes->size());
  if (!lease) {
    drop(job, DropReason::kMemory, "too many bytes wait");
    return;
  }
  job.lease = std::move(*lease);
  try {
    job.message.bytes.assign(bytes->begin(), bytes->end());
  } catch (const std::bad_alloc&) {
    stream->gate.release(job.ticket, job.processor->fail(job.message, "out of memory"));
    return;
  }
  if (const auto dropped = queue_.push(stream->queue, std::move(job)))
    drop(*dropped, DropReason::kNewerFrame, "a newer frame came first");
}

void Daemon::hold_answers_within_limit(Stream& stream) {
  const auto limit = static_cast<std::size_t>(config_->limits.max_waiting_answers);
  if (stream.gate.waiting() < limit) return;
  const auto give_up = [](const Job& job) {
    drop(job, DropReason::kHeldUp, "too many later answers wait for this frame's");
  };
  log_.warning("answers_held_up", {{"channel", stream.channel}, {"waiting", stream.gate.waiting()}});
  work_watch_.give_up(stream, give_up);
  while (stream.gate.waiting() >= limit) {
    const auto oldest = queue_.drop_oldest(stream.queue);
    if (!oldest) return;  // a worker has just begun with it: it is given up with the next message
    give_up(*oldest);
  }
}

std::optional<ByteBudget::Lease> Daemon::take_memory(const Stream& stream, std::size_t bytes) {
  while (true) {
    if (auto lease = budget_.take(static_cast<std::int64_t>(bytes), config_->limits.max_waiting_bytes))
      return lease;
    const auto oldest = queue_.drop_oldest(stream.queue);
    if (!oldest) return std::nullopt;
    drop(*oldest, DropReason::kMemory, "too many bytes wait");
  }
}

void Daemon::work(Job job) {
  Answer answer;
  {
    const WorkWatch::Entry entry(work_watch_, job, clock_.now());
    answer = work_on(job, entry.cancelled());
  }
  if (job.stream->gate.waiting() >= kMostWaitingSegmentations) answer.segmentation = {};
  job.stream->gate.release(job.ticket, std::move(answer));
}

Answer Daemon::work_on(const Job& job, const std::atomic<bool>& cancelled) {
  const FrameProcessor& processor = *job.processor;
  const auto age = clock_.now() - job.message.arrival;
  if (const auto deadline = processor.deadline(job.message);
      deadline && job.message.arrival + age > *deadline)
    return processor.drop(job.message, DropReason::kDeadline,
                          "waited " + whole_ms(age) + ", longer than deadline_ms");
  const Effort effort = job.stream->load.degraded() ? Effort::kDegraded : Effort::kFull;
  try {
    Answer answer;
    // Isolated: while this frame waits for its helpers its worker must not begin another one.
    arena_.execute([&] {
      tbb::this_task_arena::isolate([&] { answer = processor.process(job.message, effort, cancelled); });
    });
    return answer;
  } catch (const std::exception& e) {
    return processor.fail(job.message, e.what());
  }
}

void Daemon::watch_work() {
  const Clock::TimePoint now = clock_.now();
  const auto longest = std::chrono::duration_cast<Clock::TimePoint::duration>(
      std::chrono::duration<double>(config_->watchdog_s));
  const auto late = [&](const Job& job) {
    drop(job, DropReason::kDeadline,
         "not done " + whole_ms(now - job.message.arrival) + " after its arrival, longer than deadline_ms");
  };
  const auto stuck = [&](const Job& job) {
    log_.error("frame_stuck", {{"channel", job.stream->channel}, {"seq", job.message.header.seq}});
    job.stream->gate.release(job.ticket,
                             job.processor->fail(job.message, "in work for longer than watchdog_s"));
  };
  num_stuck_ = work_watch_.look(now, longest, late, stuck);
}

void Daemon::drop(const Job& job, DropReason reason, const std::string& why) {
  job.stream->gate.release(job.ticket, job.processor->drop(job.message, reason, why));
}

void Daemon::look_at_clock() {
  if (const auto jump_us = clock_watch_.look(clock_)) log_.warning("clock_set", {{"by_us", *jump_us}});
}

void Daemon::look_at_cores() {
  const double free_cores = free_cores_.look();
  const int threads = threads_worth_having(free_cores, threads_, most_threads_);
  if (threads == threads_) return;
  threads_ = threads;
  fewer_helpers_.reset();
  if (threads < most_threads_)
    fewer_helpers_.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  log_.info("threads_a_frame", {{"threads", threads},
                                {"most", most_threads_},
                                {"cores_left_percent", static_cast<int>(100 * free_cores)}});
}

Clock::TimePoint Daemon::arrival_of(const Packet& packet) {
  // LCM stamps messages by the wall clock before they wait in its queue. A wait that long is a log's time.
  constexpr std::chrono::seconds kLongestQueue{10};
  look_at_clock();
  return clock_.now() - clock_watch_.since(packet.recv_utime, clock_, kLongestQueue);
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What a daemon says: answers and status.
#include <utility>

#include "service/daemon/daemon.hpp"
#include "service/transport/handle_list_codec.hpp"
#include "service/transport/status_codec.hpp"

namespace graspd {

void Daemon::publish(Stream& stream, Answer answer) {
  const double latency_s = seconds(clock_.now() - answer.arrival);
  answer.list.set_latency(latency_s);
  if (answer.outcome == Outcome::kRefused)
    log_.warning("frame_refused",
                 {{"channel", stream.channel}, {"reason", std::string_view(answer.status_text)}});
  if (answer.outcome == Outcome::kFailed)
    log_.error("frame_failed",
               {{"channel", stream.channel}, {"reason", std::string_view(answer.status_text)}});
  follow_load(stream, answer, latency_s);
  // Counted first: whoever has the answer finds it in the next status.
  stream.health.answered(answer, latency_s);
  send(answer.handles_channel, answer.list.bytes);
  if (!answer.segmentation.empty()) send(answer.segments_channel, answer.segmentation);
}

void Daemon::send(const std::string& channel, std::span<const std::byte> bytes) {
  // A bus that is away has been told of once.
  if (!bus_.publish(channel, bytes) && bus_.connected())
    log_.error("publish_failed", {{"channel", channel}, {"bytes", bytes.size()}});
}

void Daemon::follow_load(Stream& stream, const Answer& answer, double latency_s) {
  const Clock::TimePoint now = clock_.now();
  const bool too_late = answer.drop == DropReason::kNewerFrame || answer.drop == DropReason::kDeadline;
  bool changed = false;
  if (answer.outcome == Outcome::kProcessed) changed = stream.load.answered(latency_s, now);
  if (too_late) changed = stream.load.dropped(now);
  if (!changed) return;
  if (stream.load.degraded()) {
    log_.warning("degraded", {{"channel", stream.channel}});
  } else {
    log_.info("recovered", {{"channel", stream.channel}});
  }
}

std::vector<source_status_t> Daemon::source_statuses() {
  std::vector<source_status_t> statuses;
  const Clock::TimePoint now = clock_.now();
  for (std::size_t i = 0; i < config_->sources.size(); ++i) {
    bool found = false;
    for (const auto& stream : table_.streams()) {
      if (stream->source != i) continue;
      statuses.push_back(stream->health.snapshot(now));
      statuses.back().name = config_->sources[i].name;
      statuses.back().channel = stream->channel;
      statuses.back().degraded = stream->load.degraded() ? 1 : 0;
      found = true;
    }
    if (found) continue;
    // A regular expression that nothing has matched yet.
    statuses.push_back(ChannelHealth().snapshot(now));
    statuses.back().name = config_->sources[i].name;
    statuses.back().channel = config_->sources[i].channel;
  }
  return statuses;
}

void Daemon::publish_status(std::int8_t state) {
  status_t status = health_.snapshot(state, source_statuses(), log_);
  status.num_workers = config_->workers;
  status.num_stuck = num_stuck_;
  status.waiting_bytes = budget_.used();
  status.reconnects = bus_.reconnects();
  status.ignored = table_.ignored();
  status.config_revision = control_.revision();
  status.config_error = control_.error();
  status.control_id = control_.control_id();
  status.overrides = control_.overrides();
  std::int64_t answered = 0;
  std::int64_t dropped = 0;
  for (const source_status_t& source : status.sources) {
    answered += source.processed + source.refused + source.dropped;
    dropped += source.dropped;
  }
  ++num_statuses_;
  summary_ = std::to_string(status.num_sources) + " sources, " + std::to_string(answered) +
             " frames answered, " + std::to_string(dropped) + " of them dropped, " +
             std::to_string(status.num_stuck) + " stuck, configuration " +
             std::to_string(status.config_revision);
  if (!status.config_error.empty()) summary_ += ", not taken: " + status.config_error;
  send(config_->lcm.status_channel, encode(status));
}

}  // namespace graspd

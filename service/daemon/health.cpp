// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/daemon/health.hpp"

#include <limits.h>
#include <unistd.h>

#include <utility>

#include "service/daemon/version.hpp"

namespace graspd {
namespace {

std::string host_name() {
  std::array<char, HOST_NAME_MAX + 1> text{};
  return gethostname(text.data(), text.size() - 1) == 0 ? text.data() : "";
}

}  // namespace

void ChannelHealth::received(std::int64_t seq) {
  const std::lock_guard lock(mutex_);
  ++received_;
  gaps_.add(seq);
}

void ChannelHealth::answered(const Answer& answer, double latency_s) {
  const std::lock_guard lock(mutex_);
  switch (answer.outcome) {
    case Outcome::kProcessed:
    case Outcome::kFailed:
      ++processed_;
      latencies_.add(latency_s);
      break;
    case Outcome::kRefused:
      ++refused_;
      if (answer.refusal) ++refusals_[static_cast<std::size_t>(*answer.refusal)];
      break;
    case Outcome::kDropped:
      ++dropped_;
      break;
  }
  if (answer.outcome == Outcome::kRefused || answer.outcome == Outcome::kFailed)
    last_error_ = answer.list.status_text;
}

source_status_t ChannelHealth::snapshot(Clock::TimePoint now) {
  const std::lock_guard lock(mutex_);
  source_status_t status;
  status.received = received_;
  status.processed = processed_;
  status.dropped = dropped_;
  status.refused = refused_;
  status.pending = received_ - processed_ - dropped_ - refused_;
  status.lost = gaps_.lost();
  status.rate = rate_.update(received_, now);
  status.latency_p50 = latencies_.percentile(0.5);
  status.latency_p99 = latencies_.percentile(0.99);
  for (std::size_t i = 0; i < refusals_.size(); ++i) {
    if (refusals_[i] == 0) continue;
    reason_count_t count;
    count.reason = name(static_cast<RefusalReason>(i));
    count.count = refusals_[i];
    status.refusals.push_back(count);
  }
  status.num_refusals = static_cast<std::int32_t>(status.refusals.size());
  status.last_error = last_error_;
  return status;
}

ProcessHealth::ProcessHealth(const Clock& clock) : clock_(clock), start_(clock.now()), host_(host_name()) {}

status_t ProcessHealth::snapshot(std::int8_t state, std::vector<source_status_t> sources) {
  const Clock::TimePoint now = clock_.now();
  const ProcessUsage usage = usage_.measure(now);
  status_t status{};
  status.utime = clock_.wall_utime();
  status.version = kVersion;
  status.host = host_;
  status.pid = getpid();
  status.state = state;
  status.uptime = seconds(now - start_);
  status.cpu = usage.cpu;
  status.rss = usage.rss_bytes;
  status.peak_rss = usage.peak_rss_bytes;
  status.num_sources = static_cast<std::int32_t>(sources.size());
  status.sources = std::move(sources);
  return status;
}

}  // namespace graspd

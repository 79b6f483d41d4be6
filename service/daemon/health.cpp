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

/// Those that happened; `names` gives the word of an index.
template <std::size_t n, class Names>
std::vector<reason_count_t> wire_counts(const std::array<std::int64_t, n>& counts, Names names) {
  std::vector<reason_count_t> result;
  for (std::size_t i = 0; i < n; ++i) {
    if (counts[i] == 0) continue;
    reason_count_t entry;
    entry.reason = names(i);
    entry.count = counts[i];
    result.push_back(entry);
  }
  return result;
}

}  // namespace

void ChannelHealth::received(std::int64_t seq, Clock::TimePoint now) {
  const std::lock_guard lock(mutex_);
  ++received_;
  newest_ = now;
  gaps_.add(seq);
}

void ChannelHealth::answered(const Answer& answer, double latency_s) {
  const std::lock_guard lock(mutex_);
  switch (answer.outcome) {
    case Outcome::kProcessed:
    case Outcome::kFailed:
      ++processed_;
      failed_ += answer.outcome == Outcome::kFailed ? 1 : 0;
      coarse_ += answer.degraded ? 1 : 0;
      latencies_.add(latency_s);
      break;
    case Outcome::kRefused:
      ++refused_;
      if (answer.refusal) ++refusals_[static_cast<std::size_t>(*answer.refusal)];
      break;
    case Outcome::kDropped:
      ++dropped_;
      if (answer.drop) ++drops_[static_cast<std::size_t>(*answer.drop)];
      break;
  }
  if (answer.outcome == Outcome::kRefused || answer.outcome == Outcome::kFailed)
    last_error_ = answer.status_text;
}

source_status_t ChannelHealth::snapshot(Clock::TimePoint now) {
  const std::lock_guard lock(mutex_);
  source_status_t status{};
  status.received = received_;
  status.processed = processed_;
  status.failed = failed_;
  status.coarse = coarse_;
  status.dropped = dropped_;
  status.refused = refused_;
  status.pending = received_ - processed_ - dropped_ - refused_;
  status.lost = gaps_.lost();
  status.rate = rate_.update(received_, now);
  status.age = newest_ ? seconds(now - *newest_) : -1;
  status.latency_p50 = latencies_.percentile(0.5);
  status.latency_p99 = latencies_.percentile(0.99);
  status.drops = wire_counts(drops_, [](std::size_t i) { return name(static_cast<DropReason>(i)); });
  status.num_drops = static_cast<std::int32_t>(status.drops.size());
  status.refusals = wire_counts(refusals_, [](std::size_t i) { return name(static_cast<RefusalReason>(i)); });
  status.num_refusals = static_cast<std::int32_t>(status.refusals.size());
  status.last_error = last_error_;
  return status;
}

ProcessHealth::ProcessHealth(const Clock& clock) : clock_(clock), start_(clock.now()), host_(host_name()) {}

status_t ProcessHealth::snapshot(std::int8_t state, std::vector<source_status_t> sources, const Log& log) {
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
  status.num_threads = usage.threads;
  status.num_descriptors = usage.descriptors;
  const NetworkLosses losses = losses_.measure();
  status.receive_errors = losses.receive_errors;
  status.reassembly_errors = losses.reassembly_errors;
  status.log_lost = log.lost();
  for (const LogReport& report : log.reports())
    status.errors.push_back({report.utime, report.event, report.line, report.count});
  status.num_errors = static_cast<std::int32_t>(status.errors.size());
  status.num_sources = static_cast<std::int32_t>(sources.size());
  status.sources = std::move(sources);
  return status;
}

}  // namespace graspd

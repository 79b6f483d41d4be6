// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Counts what happens to messages, and says it once a second.
#pragma once
#include <array>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "graspd/source_status_t.hpp"
#include "graspd/status_t.hpp"
#include "service/daemon/answer.hpp"
#include "service/runtime/clock.hpp"
#include "service/runtime/counters.hpp"
#include "service/runtime/log.hpp"
#include "service/runtime/network_losses.hpp"
#include "service/runtime/process_usage.hpp"

namespace graspd {

/// Of one channel. All functions may be called from any thread; a snapshot's counts add up.
class ChannelHealth {
 public:
  /// `seq` as in the message; negative: unknown.
  void received(std::int64_t seq, Clock::TimePoint now);
  void answered(const Answer& answer, double latency_s);
  /// The rate is that since the snapshot before.
  [[nodiscard]] source_status_t snapshot(Clock::TimePoint now);

 private:
  std::mutex mutex_;
  std::int64_t received_ = 0;
  std::int64_t processed_ = 0;
  std::int64_t failed_ = 0;
  std::int64_t coarse_ = 0;
  std::int64_t dropped_ = 0;
  std::int64_t refused_ = 0;
  std::array<std::int64_t, kNumDropReasons> drops_{};
  std::array<std::int64_t, kNumRefusalReasons> refusals_{};
  std::optional<Clock::TimePoint> newest_;
  std::string last_error_;
  SequenceGaps gaps_;
  RateMeter rate_;
  LatencyWindow latencies_;
};

/// Of the process.
class ProcessHealth {
 public:
  explicit ProcessHealth(const Clock& clock);

  /// `state` is one of status_t's. Whatever is not the process's own is left at zero.
  [[nodiscard]] status_t snapshot(std::int8_t state, std::vector<source_status_t> sources, const Log& log);

 private:
  const Clock& clock_;
  const Clock::TimePoint start_;
  const std::string host_;
  const NetworkLossMeter losses_;
  ProcessUsageMeter usage_;
};

}  // namespace graspd

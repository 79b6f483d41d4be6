// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Logs in, a log of handle lists out: the daemon's answers, found offline.
#pragma once
#include <cstdint>
#include <deque>
#include <functional>
#include <future>
#include <string>
#include <vector>

#include "client/replay/archive.hpp"
#include "client/replay/channel_table.hpp"
#include "client/replay/frame_threads.hpp"
#include "client/replay/replay_output.hpp"
#include "client/replay/selection.hpp"
#include "service/config/service_config.hpp"
#include "service/runtime/clock.hpp"
#include "service/transport/seal.hpp"

namespace graspd {

/// Everything that decides what the output is, and how it is made.
struct ReplayConfig {
  ServiceConfig service;
  std::vector<LogPart> parts;
  std::string keep;  ///< regular expression of the original channels that go into the output too
  Selection selection;
  bool times = false;  ///< lists carry the measured times, which differ from run to run; else zeros
  // The output does not depend on these.
  std::vector<LogPart> reading;    ///< what is read of each of the parts; empty: all of it
  std::int64_t frames_before = 0;  ///< clouds of sources that stand before what is read
  int threads = 1;
  double checkpoint_s = 1;
};

/// Equal for runs whose outputs are equal.
[[nodiscard]] std::string identity_of(const ReplayConfig& config);

/// Where a run stands.
struct ReplayProgress {
  const ReplayState& state;
  std::int64_t bytes_done = 0;
  std::int64_t bytes_in_all = 0;
};

class Replay {
 public:
  /// Called after each event that is written.
  using OnProgress = std::function<void(const ReplayProgress&)>;

  /// Goes on from the output's start. Throws ConfigError, EventLogError.
  Replay(ReplayConfig config, ReplayOutput& output);

  /// False when it was stopped (stop_requested()); what was done until then is in the checkpoint.
  [[nodiscard]] bool run(const OnProgress& on_progress);

  [[nodiscard]] const ReplayState& state() const { return state_; }
  /// Clouds that are signed where there is no key; they are refused.
  [[nodiscard]] std::int64_t unopened() const { return unopened_; }

 private:
  /// An event on its way through.
  struct Item {
    EventHead head;
    FrameMessage message;
    const ChannelUse* use = nullptr;
    std::future<EncodedAnswer> answer;  // of clouds
    ArchivePosition after;
    std::int64_t frames_seen = 0;  // up to it
    std::int64_t bytes_done = 0;
  };

  bool take_next();
  [[nodiscard]] EncodedAnswer answer(const Item& item) const;
  void commit(Item& item);
  void checkpoint_when_due();

  ReplayConfig config_;
  ReplayOutput& output_;
  SystemClock clock_;
  std::vector<SealKey> keys_;
  ChannelTable channels_;
  ReplayState state_;
  Archive archive_;
  bool ended_ = false;
  std::int64_t frames_read_ = 0;
  std::int64_t waiting_bytes_ = 0;
  std::int64_t unopened_ = 0;
  Clock::TimePoint next_checkpoint_;
  std::deque<Item> items_;
  FrameThreads threads_;  // last: its work uses the rest
};

}  // namespace graspd

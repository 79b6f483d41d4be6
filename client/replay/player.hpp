// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Events of logs in their own rhythm, from any place, at any speed.
#pragma once
#include <chrono>
#include <cstdint>
#include <optional>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

#include "client/replay/archive.hpp"
#include "client/replay/archive_search.hpp"

namespace graspd {

/// Time is an argument: the caller waits and sends.
class Player {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  /// `channels`: a regular expression for whole names. Begins to play at `now`. `scan`: seeks read all
  /// headers from the start on.
  Player(std::vector<LogPart> parts, const std::string& channels, double speed, TimePoint now,
         bool scan = false);

  /// When the next event is due; nothing while paused, and at the end.
  [[nodiscard]] std::optional<TimePoint> due() const;
  [[nodiscard]] bool ended() const { return !pending_; }
  [[nodiscard]] bool paused() const { return paused_; }
  [[nodiscard]] double speed() const { return speed_; }
  /// Logs that seeks have to read whole, and why; see ArchiveSearch.
  [[nodiscard]] std::vector<std::string> notes() const { return search_.notes(); }
  /// Of the log's time since its first event, now [s].
  [[nodiscard]] double position_s(TimePoint now) const;

  /// The event that is due, with its message; the next one becomes due.
  LoggedEvent take();

  /// pause, play, toggle, seek SECONDS, skip SECONDS (back with -), speed FACTOR. False for anything else.
  bool obey(std::string_view command, TimePoint now);

 private:
  void rebase(TimePoint now);
  void seek(double position_s, TimePoint now);
  void advance();

  std::vector<LogPart> parts_;
  std::regex channels_;
  bool scan_;
  ArchiveSearch search_;
  Archive archive_;
  std::optional<EventHead> pending_;
  std::int64_t first_utime_ = 0;
  double speed_;
  bool paused_ = false;
  double base_s_ = 0;  // position at base_time_
  TimePoint base_time_;
};

}  // namespace graspd

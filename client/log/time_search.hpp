// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Finds a time in a log of any size in a few reads.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "client/log/event_log_reader.hpp"

namespace graspd {

struct TimeSearchConfig {
  /// Events may be recorded so much earlier than one that stands before them [us]: threads that write one
  /// log.
  std::int64_t disorder_us = 10'000'000;
  std::int64_t sample_bytes =
      16 << 20;  ///< times are looked at in such distances, in large logs in larger ones
  std::int64_t most_samples = 256;
  std::int64_t narrow_bytes = 1 << 20;  ///< a place is known well enough
};

/// Looks at events here and there in a part of a log, and takes it that between them time goes on as it does
/// where it looks. A message that holds a log of its own can be mistaken for the log.
class TimeSearch {
 public:
  /// Throws EventLogError when the log cannot be read, as all that follows.
  TimeSearch(std::filesystem::path log, const EventLogReader::Part& part,
             const TimeSearchConfig& config = {});

  /// A stretch that begins at the part's or an event's start, outside of which no event has a time in
  /// [from, to) [us]. The whole part where times are seen to go backwards.
  [[nodiscard]] EventLogReader::Part stretch(std::int64_t from_utime, std::int64_t to_utime);

  /// Of the last event [us]; nothing without any.
  [[nodiscard]] std::optional<std::int64_t> last_utime();

  /// In one line where times go backwards, as far as that was seen; empty: nowhere.
  [[nodiscard]] const std::string& disorder() const { return disorder_; }

 private:
  /// The first event beginning in [begin, end) that another one or the part's end follows at once.
  [[nodiscard]] bool sample(std::int64_t begin, std::int64_t end);
  void sample_ends();
  void sample_all();
  struct Bracket {
    std::int64_t before = 0;  ///< start of an event before the time
    std::int64_t after = 0;   ///< of one that is not
  };
  /// The first event must be before the time, the last must not.
  [[nodiscard]] Bracket bracket(std::int64_t utime);
  void check_order();

  std::filesystem::path log_;
  EventLogReader::Part part_;
  TimeSearchConfig config_;
  bool ends_known_ = false, all_sampled_ = false;
  std::map<std::int64_t, std::int64_t> samples_;  // start of an event -> its time
  std::map<std::int64_t, std::int64_t>::iterator last_sample_;
  std::string disorder_;
};

}  // namespace graspd

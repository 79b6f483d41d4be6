// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Logs, or stretches of them, one after the other as one sequence of events.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <vector>

#include "client/log/event_log_reader.hpp"

namespace graspd {

struct LogPart {
  std::filesystem::path path;
  EventLogReader::Part part{};
};

/// Where a reader goes on: behind an event.
struct ArchivePosition {
  std::size_t part = 0;      ///< index of the log
  std::int64_t offset = -1;  ///< in its file [bytes]; -1: where the part begins
  std::int64_t skipped = 0;  ///< bytes before it that were no events
};

/// Takes memory for one event, whatever the logs' size. Throws EventLogError for a log that cannot be read.
class Archive {
 public:
  explicit Archive(std::vector<LogPart> parts, const ArchivePosition& start = {});

  /// False at the end of the last log.
  [[nodiscard]] bool next_head(EventHead& head);
  /// Of the event that next_head() gave last.
  template <class Allocator>
  void read_message(std::vector<std::byte, Allocator>& bytes,
                    std::int64_t most = std::numeric_limits<std::int64_t>::max()) {
    reader_->read_message(bytes, most);
  }

  [[nodiscard]] ArchivePosition position() const;
  [[nodiscard]] std::int64_t bytes_done() const { return bytes_before_ + reader_position(); }
  [[nodiscard]] std::int64_t bytes_in_all() const { return bytes_in_all_; }
  /// The log that the last event is of, as an index.
  [[nodiscard]] std::size_t part() const { return part_; }

 private:
  void open(std::int64_t offset);
  [[nodiscard]] std::int64_t reader_position() const;

  std::vector<LogPart> parts_;
  std::vector<std::int64_t> sizes_;  // of the parts [bytes]
  std::size_t part_ = 0;
  std::unique_ptr<EventLogReader> reader_;  // none behind the last log
  std::int64_t skipped_before_ = 0;
  std::int64_t bytes_before_ = 0;
  std::int64_t bytes_in_all_ = 0;
};

}  // namespace graspd

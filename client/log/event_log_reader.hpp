// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Reads LCM event logs. Own code, because liblcm's reader allocates and writes to whatever a length in the
// file asks for.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "client/log/event_log_file.hpp"

namespace graspd {

struct LoggedEvent {
  std::int64_t recv_utime = 0;  ///< [us] since 1970
  std::string channel;
  std::vector<std::byte> bytes;
};

/// Gives every whole event of a file. What is none - an event cut short at the end, damaged bytes in between
/// - is skipped up to the next event and counted. Takes memory for one event, and time in proportion to the
/// file, whatever is in it.
class EventLogReader {
 public:
  /// Throws EventLogError when the file cannot be read.
  explicit EventLogReader(std::filesystem::path path);

  /// False at the end of the file.
  [[nodiscard]] bool next(LoggedEvent& event);

  [[nodiscard]] std::int64_t skipped_bytes() const { return skipped_bytes_; }

 private:
  /// Moves position_ to the next header that is one; false: there is none.
  [[nodiscard]] bool find_event();

  std::filesystem::path path_;
  std::ifstream file_;
  std::int64_t size_ = 0;
  std::int64_t position_ = 0;  // where the next event is looked for
  std::int64_t skipped_bytes_ = 0;
};

/// Whether the file starts as an event log does.
[[nodiscard]] bool is_event_log(const std::filesystem::path& path);

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Reads LCM event logs. Own code, because liblcm's reader allocates and writes to whatever a length in the
// file asks for.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "client/log/event_log_file.hpp"

namespace graspd {

/// An event without its bytes.
struct EventHead {
  std::int64_t recv_utime = 0;  ///< [us] since 1970
  std::string channel;
  std::int64_t size = 0;      ///< of its message [bytes]
  std::int64_t position = 0;  ///< of the event in the file [bytes]
};

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
  explicit EventLogReader(std::filesystem::path path) : EventLogReader(std::move(path), {}) {}

  /// A part of a file [bytes]: the events that start in it. One that begins at an event's start gives the
  /// same events as reading from the start of the file would.
  struct Part {
    std::int64_t begin = 0;
    std::int64_t end = std::numeric_limits<std::int64_t>::max();  ///< one past the last
  };
  EventLogReader(std::filesystem::path path, const Part& part);

  /// False at the end of the file, or of the part.
  [[nodiscard]] bool next(LoggedEvent& event);

  /// As next(), without reading the message; read_message() does, until the next event is asked for.
  [[nodiscard]] bool next_head(EventHead& head);
  /// Or its first `most` bytes.
  template <class Allocator>
  void read_message(std::vector<std::byte, Allocator>& bytes,
                    std::int64_t most = std::numeric_limits<std::int64_t>::max()) {
    bytes.resize(static_cast<std::size_t>(std::min(most, message_size_)));
    read_into(bytes);
  }

  /// Where the next event is looked for: after the last one, at the end of the part behind the last.
  [[nodiscard]] std::int64_t position() const { return position_; }
  /// Of the file [bytes].
  [[nodiscard]] std::int64_t size() const { return size_; }
  [[nodiscard]] std::int64_t skipped_bytes() const { return skipped_bytes_; }

 private:
  struct Header;
  /// As many bytes of the message as there is room for.
  void read_into(std::span<std::byte> bytes);
  [[nodiscard]] static std::int64_t event_bytes(const Header& header);
  /// Nothing unless the bytes start with a header that can be one.
  [[nodiscard]] static std::optional<Header> parse_header(std::span<const char> bytes);
  /// Of an event that is whole, as far as its lengths tell.
  [[nodiscard]] std::optional<Header> header_at(std::int64_t position);
  /// Moves position_ to the next header that is one; nothing: there is none.
  [[nodiscard]] std::optional<Header> find_event();

  std::filesystem::path path_;
  std::ifstream file_;
  std::int64_t size_ = 0;
  std::int64_t end_ = 0;           // no event starts here or later
  std::int64_t position_ = 0;      // where the next event is looked for
  std::int64_t message_size_ = 0;  // of the last event [bytes]; it ends at position_
  std::int64_t skipped_bytes_ = 0;
};

/// Whether the file starts as an event log does.
[[nodiscard]] bool is_event_log(const std::filesystem::path& path);

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// LCM event log files, written so that what is in them stays readable whatever happens.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace graspd {

/// A log that cannot be written; what() is one line: `path: reason`.
class EventLogError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One file in the format of lcm-logger and lcm-logplayer. Every event reaches the kernel as a whole: when
/// the process dies or the disk is full, the file ends with the last complete event.
class EventLogFile {
 public:
  enum class Existing { kRefuse, kOverwrite };

  /// Throws EventLogError when the file cannot be created, or exists and must not.
  EventLogFile(std::filesystem::path path, Existing existing);

  /// Goes on with a file behind its first `size` bytes, which hold so many events; what follows them is cut
  /// off. Throws EventLogError when the file is shorter or cannot be written.
  EventLogFile(std::filesystem::path path, std::int64_t size, std::int64_t events);
  ~EventLogFile();
  EventLogFile(const EventLogFile&) = delete;
  EventLogFile& operator=(const EventLogFile&) = delete;

  /// Throws EventLogError when the event cannot be written; the file then ends with the event before.
  void write(std::int64_t recv_utime, std::string_view channel, std::span<const std::byte> bytes);

  /// Waits until all events are on the disk. Throws EventLogError.
  void sync();

  [[nodiscard]] std::int64_t size() const { return size_; }
  [[nodiscard]] std::int64_t events() const { return events_; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int file_ = -1;
  std::int64_t size_ = 0;
  std::int64_t events_ = 0;
  std::vector<std::byte> buffer_;
};

/// Bytes that an event takes in a file.
[[nodiscard]] std::int64_t event_size(std::string_view channel, std::span<const std::byte> bytes);

}  // namespace graspd

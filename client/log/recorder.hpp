// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// A recording: log files one after the other, room on the disk, what was written by channel.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "client/log/event_log_file.hpp"

namespace graspd {

struct RecorderConfig {
  std::filesystem::path path;       ///< of the log; with rotation .00, .01, ... follow it
  std::int64_t max_file_bytes = 0;  ///< a file that would grow beyond it is followed by the next; 0: one file
  std::int64_t min_free_bytes = 0;  ///< the disk keeps at least so much
  EventLogFile::Existing existing = EventLogFile::Existing::kRefuse;
};

struct ChannelCount {
  std::int64_t events = 0;
  std::int64_t bytes = 0;
};

/// The n-th file of a log with rotation: two digits at least.
[[nodiscard]] std::filesystem::path rotated_path(const std::filesystem::path& path, int n);

class Recorder {
 public:
  /// Free bytes of the disk that holds a path.
  using FreeBytes = std::function<std::int64_t(const std::filesystem::path&)>;

  /// Creates the first file. Throws EventLogError.
  explicit Recorder(RecorderConfig config, FreeBytes free_bytes = free_bytes_of_disk);

  /// Throws EventLogError when the disk would be left with less than it must keep, or the log cannot be
  /// written; all events before are in the files.
  void record(std::int64_t recv_utime, std::string_view channel, std::span<const std::byte> bytes);

  [[nodiscard]] const std::map<std::string, ChannelCount, std::less<>>& channels() const { return channels_; }
  [[nodiscard]] ChannelCount total() const;
  [[nodiscard]] int files() const { return files_; }

  /// As the kernel has it for people without privileges; throws EventLogError.
  [[nodiscard]] static std::int64_t free_bytes_of_disk(const std::filesystem::path& path);

 private:
  void open_next();
  void keep_room(std::int64_t bytes) const;

  RecorderConfig config_;
  FreeBytes free_bytes_;
  std::unique_ptr<EventLogFile> file_;
  int files_ = 0;
  std::map<std::string, ChannelCount, std::less<>> channels_;
};

}  // namespace graspd

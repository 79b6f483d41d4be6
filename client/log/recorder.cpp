// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/log/recorder.hpp"

#include "client/common/text.hpp"

namespace graspd {

std::filesystem::path rotated_path(const std::filesystem::path& path, int n) {
  return path.string() + printed(".%02d", n);
}

std::int64_t Recorder::free_bytes_of_disk(const std::filesystem::path& path) {
  std::error_code error;
  const auto space = std::filesystem::space(path, error);
  if (error)
    throw EventLogError(path.string() + ": the free room on the disk cannot be read: " + error.message());
  return static_cast<std::int64_t>(space.available);
}

Recorder::Recorder(RecorderConfig config, FreeBytes free_bytes)
    : config_(std::move(config)), free_bytes_(std::move(free_bytes)) {
  open_next();
}

void Recorder::open_next() {
  const bool rotates = config_.max_file_bytes > 0;
  const std::filesystem::path path = rotates ? rotated_path(config_.path, files_) : config_.path;
  // Closed first: the old file is whole when the new one appears.
  file_.reset();
  file_ = std::make_unique<EventLogFile>(path, config_.existing);
  ++files_;
}

void Recorder::keep_room(std::int64_t bytes) const {
  if (config_.min_free_bytes <= 0) return;
  const std::int64_t left = free_bytes_(file_->path()) - bytes;
  if (left >= config_.min_free_bytes) return;
  throw EventLogError(
      printed("%s: recording stopped: %.1f MB would be left on the disk, at least %.1f MB are to stay free",
              file_->path().c_str(), 1e-6 * static_cast<double>(left),
              1e-6 * static_cast<double>(config_.min_free_bytes)));
}

void Recorder::record(std::int64_t recv_utime, std::string_view channel, std::span<const std::byte> bytes) {
  const std::int64_t size = event_size(channel, bytes);
  keep_room(size);
  if (config_.max_file_bytes > 0 && file_->size() > 0 && file_->size() + size > config_.max_file_bytes)
    open_next();
  file_->write(recv_utime, channel, bytes);
  auto entry = channels_.find(channel);
  if (entry == channels_.end()) entry = channels_.emplace(std::string(channel), ChannelCount{}).first;
  ++entry->second.events;
  entry->second.bytes += static_cast<std::int64_t>(bytes.size());
}

ChannelCount Recorder::total() const {
  ChannelCount sum;
  for (const auto& [name, count] : channels_) {
    sum.events += count.events;
    sum.bytes += count.bytes;
  }
  return sum;
}

}  // namespace graspd

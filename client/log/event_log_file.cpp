// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/log/event_log_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <concepts>
#include <cstring>

namespace graspd {
namespace {

constexpr std::uint32_t kSyncWord = 0xEDA1DA01;
constexpr std::size_t kEventHeader = 28;

template <std::integral T>
void append(std::vector<std::byte>& buffer, T value) {
  // Big-endian.
  for (int shift = 8 * (static_cast<int>(sizeof(T)) - 1); shift >= 0; shift -= 8) {
    buffer.push_back(static_cast<std::byte>((value >> shift) & 0xff));
  }
}

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what, int error) {
  throw EventLogError(path.string() + ": " + what + ": " + std::strerror(error));
}

}  // namespace

std::int64_t event_size(std::string_view channel, std::span<const std::byte> bytes) {
  return static_cast<std::int64_t>(kEventHeader + channel.size() + bytes.size());
}

EventLogFile::EventLogFile(std::filesystem::path path, Existing existing) : path_(std::move(path)) {
  const int exclusive = existing == Existing::kRefuse ? O_EXCL : O_TRUNC;
  file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | exclusive, 0644);
  if (file_ < 0) fail(path_, "the log cannot be created", errno);
}

EventLogFile::EventLogFile(std::filesystem::path path, std::int64_t size, std::int64_t events)
    : path_(std::move(path)), size_(size), events_(events) {
  file_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
  if (file_ < 0) fail(path_, "the log cannot be continued", errno);
  const off_t there = ::lseek(file_, 0, SEEK_END);
  if (there < size || ::ftruncate(file_, size) != 0 || ::lseek(file_, size, SEEK_SET) != size) {
    const int error = there < size ? EINVAL : errno;
    ::close(file_);
    fail(path_, there < size ? "the log is shorter than it was" : "the log cannot be continued", error);
  }
}

EventLogFile::~EventLogFile() {
  ::close(file_);
}

void EventLogFile::write(std::int64_t recv_utime, std::string_view channel,
                         std::span<const std::byte> bytes) {
  buffer_.clear();
  append(buffer_, kSyncWord);
  append(buffer_, events_);
  append(buffer_, recv_utime);
  append(buffer_, static_cast<std::int32_t>(channel.size()));
  append(buffer_, static_cast<std::int32_t>(bytes.size()));
  const auto name = std::as_bytes(std::span(channel.data(), channel.size()));
  buffer_.insert(buffer_.end(), name.begin(), name.end());
  buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
  std::size_t done = 0;
  while (done < buffer_.size()) {
    const ssize_t n = ::write(file_, buffer_.data() + done, buffer_.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) {
      const int error = n < 0 ? errno : ENOSPC;
      // Nobody can read half an event; if even this fails, readers stop there anyhow.
      if (::ftruncate(file_, size_) == 0) ::lseek(file_, size_, SEEK_SET);
      fail(path_, "the log cannot be written", error);
    }
    done += static_cast<std::size_t>(n);
  }
  size_ += static_cast<std::int64_t>(buffer_.size());
  ++events_;
}

void EventLogFile::sync() {
  if (::fdatasync(file_) != 0) fail(path_, "the log cannot be written", errno);
}

}  // namespace graspd

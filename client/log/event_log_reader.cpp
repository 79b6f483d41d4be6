// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/log/event_log_reader.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <optional>
#include <span>

#include "service/transport/byte_reader.hpp"

namespace graspd {
namespace {

constexpr std::array<char, 4> kSyncWord{'\xed', '\xa1', '\xda', '\x01'};
constexpr std::size_t kHeaderBytes = 28;
constexpr std::int32_t kMaxChannel = 255;  // LCM itself sends 63 characters at most
constexpr std::int32_t kMaxData = std::int32_t{1} << 30;

struct Header {
  std::int64_t recv_utime = 0;
  std::int32_t channel = 0;  ///< [bytes]
  std::int32_t data = 0;     ///< [bytes]

  [[nodiscard]] std::int64_t event_bytes() const {
    return static_cast<std::int64_t>(kHeaderBytes) + channel + data;
  }
};

/// Nothing unless the bytes start with a header that can be one.
std::optional<Header> parse_header(std::span<const char> bytes) {
  if (bytes.size() < kHeaderBytes || !std::equal(kSyncWord.begin(), kSyncWord.end(), bytes.begin()))
    return std::nullopt;
  ByteReader reader(std::as_bytes(bytes));
  reader.skip("sync word", kSyncWord.size());
  reader.skip("event number", sizeof(std::int64_t));
  Header header;
  header.recv_utime = reader.int64("time");
  header.channel = reader.int32("channel length");
  header.data = reader.int32("data length");
  const bool possible =
      header.channel > 0 && header.channel <= kMaxChannel && header.data >= 0 && header.data <= kMaxData;
  return possible ? std::optional(header) : std::nullopt;
}

}  // namespace

EventLogReader::EventLogReader(std::filesystem::path path, const Part& part) : path_(std::move(path)) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path_, error);
  if (error) throw EventLogError(path_.string() + ": the log cannot be read: " + error.message());
  errno = 0;
  file_.open(path_, std::ios::binary);
  if (!file_) throw EventLogError(path_.string() + ": the log cannot be read: " + std::strerror(errno));
  size_ = static_cast<std::int64_t>(size);
  end_ = std::clamp<std::int64_t>(part.end, 0, size_);
  position_ = std::clamp<std::int64_t>(part.begin, 0, end_);
}

bool EventLogReader::find_event() {
  std::array<char, 4096> chunk{};
  while (position_ < end_) {
    file_.clear();
    file_.seekg(position_);
    file_.read(chunk.data(), std::ssize(chunk));
    const auto size = static_cast<std::size_t>(std::max<std::streamsize>(file_.gcount(), 0));
    if (size < kHeaderBytes) return false;
    // Headers that reach over the chunk's end are looked at again in the next one.
    for (std::size_t i = 0; i + kHeaderBytes <= size; ++i) {
      const auto header = parse_header(std::span(chunk).subspan(i, kHeaderBytes));
      const std::int64_t start = position_ + static_cast<std::int64_t>(i);
      if (start >= end_) return false;
      if (!header || start + header->event_bytes() > size_) continue;
      position_ = start;
      return true;
    }
    position_ += static_cast<std::int64_t>(size - kHeaderBytes + 1);
  }
  return false;
}

bool EventLogReader::next(LoggedEvent& event) {
  EventHead head;
  if (!next_head(head)) return false;
  event.recv_utime = head.recv_utime;
  event.channel = std::move(head.channel);
  read_message(event.bytes);
  return true;
}

bool EventLogReader::next_head(EventHead& head) {
  const std::int64_t expected = position_;
  if (!find_event()) {
    skipped_bytes_ += std::max<std::int64_t>(end_ - expected, 0);
    position_ = std::max(end_, expected);
    return false;
  }
  skipped_bytes_ += position_ - expected;
  std::array<char, kHeaderBytes> bytes{};
  file_.clear();
  file_.seekg(position_);
  file_.read(bytes.data(), std::ssize(bytes));
  const auto header = parse_header(bytes);
  if (!header) throw EventLogError(path_.string() + ": the log cannot be read: it changes meanwhile");
  head.recv_utime = header->recv_utime;
  head.channel.resize(static_cast<std::size_t>(header->channel));
  file_.read(head.channel.data(), std::ssize(head.channel));
  if (!file_) throw EventLogError(path_.string() + ": the log cannot be read: " + std::strerror(errno));
  head.position = position_;
  head.size = header->data;
  message_size_ = header->data;
  position_ += header->event_bytes();
  return true;
}

void EventLogReader::read_message(std::vector<std::byte>& bytes, std::int64_t most) {
  bytes.resize(static_cast<std::size_t>(std::min(most, message_size_)));
  file_.clear();
  file_.seekg(position_ - message_size_);
  file_.read(reinterpret_cast<char*>(bytes.data()), std::ssize(bytes));
  if (!file_) throw EventLogError(path_.string() + ": the log cannot be read: " + std::strerror(errno));
}

bool is_event_log(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  std::ifstream file(path, std::ios::binary);
  std::array<char, kSyncWord.size()> start{};
  return file.read(start.data(), std::ssize(start)) && start == kSyncWord;
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/log/event_log_reader.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>

#include "service/transport/byte_reader.hpp"

namespace graspd {
namespace {

constexpr std::string_view kSyncWord{"\xed\xa1\xda\x01", 4};
constexpr std::size_t kHeaderBytes = 28;
constexpr std::size_t kChunkBytes = 64 << 10;
constexpr std::int32_t kMaxChannel = 255;  // LCM itself sends 63 characters at most
constexpr std::int32_t kMaxData = std::int32_t{1} << 30;

}  // namespace

struct EventLogReader::Header {
  std::int64_t recv_utime = 0;
  std::int32_t channel = 0;  ///< [bytes]
  std::int32_t data = 0;     ///< [bytes]
};

std::int64_t EventLogReader::event_bytes(const Header& header) {
  return static_cast<std::int64_t>(kHeaderBytes) + header.channel + header.data;
}

std::optional<EventLogReader::Header> EventLogReader::parse_header(std::span<const char> bytes) {
  if (bytes.size() < kHeaderBytes || !std::equal(kSyncWord.begin(), kSyncWord.end(), bytes.begin()))
    return std::nullopt;
  ByteReader reader(std::as_bytes(bytes.first(kHeaderBytes)));
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

std::optional<EventLogReader::Header> EventLogReader::header_at(std::int64_t position) {
  std::array<char, kHeaderBytes> bytes{};
  file_.clear();
  file_.seekg(position);
  if (!file_.read(bytes.data(), std::ssize(bytes))) return std::nullopt;
  const auto header = parse_header(bytes);
  return header && position + event_bytes(*header) <= size_ ? header : std::nullopt;
}

std::optional<EventLogReader::Header> EventLogReader::find_event() {
  if (position_ >= end_) return std::nullopt;
  // Nearly always an event follows the last one; what lies between events is read in larger pieces.
  if (const auto header = header_at(position_)) return header;
  std::vector<char> chunk(kChunkBytes);
  while (position_ < end_) {
    file_.clear();
    file_.seekg(position_);
    file_.read(chunk.data(), std::ssize(chunk));
    const auto size = static_cast<std::size_t>(std::max<std::streamsize>(file_.gcount(), 0));
    if (size < kHeaderBytes) return std::nullopt;
    const std::string_view bytes(chunk.data(), size);
    for (auto i = bytes.find(kSyncWord); i != bytes.npos; i = bytes.find(kSyncWord, i + 1)) {
      const auto header = parse_header(bytes.substr(i));
      const std::int64_t start = position_ + static_cast<std::int64_t>(i);
      if (start >= end_) return std::nullopt;
      if (!header || start + event_bytes(*header) > size_) continue;
      position_ = start;
      return header;
    }
    // Headers that reach over the chunk's end are looked at again in the next one.
    position_ += static_cast<std::int64_t>(size - kHeaderBytes + 1);
  }
  return std::nullopt;
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
  const auto header = find_event();
  if (!header) {
    skipped_bytes_ += std::max<std::int64_t>(end_ - expected, 0);
    position_ = std::max(end_, expected);
    return false;
  }
  skipped_bytes_ += position_ - expected;
  head.recv_utime = header->recv_utime;
  head.channel.resize(static_cast<std::size_t>(header->channel));
  file_.clear();
  file_.seekg(position_ + static_cast<std::int64_t>(kHeaderBytes));
  file_.read(head.channel.data(), std::ssize(head.channel));
  if (!file_) throw EventLogError(path_.string() + ": the log cannot be read: " + std::strerror(errno));
  head.position = position_;
  head.size = header->data;
  message_size_ = header->data;
  position_ += event_bytes(*header);
  return true;
}

void EventLogReader::read_into(std::span<std::byte> bytes) {
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
  return file.read(start.data(), std::ssize(start)) &&
         std::equal(start.begin(), start.end(), kSyncWord.begin());
}

}  // namespace graspd

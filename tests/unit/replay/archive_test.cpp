// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/replay/archive.hpp"

#include <gtest/gtest.h>

#include "client/log/log_parts.hpp"
#include "tests/support/temp_folder.hpp"

namespace graspd {
namespace {

std::span<const std::byte> bytes_of(const std::string& text) {
  return std::as_bytes(std::span(text));
}

/// Two logs of three events, with rubbish in the middle of the second.
std::vector<LogPart> two_logs(const TempFolder& folder) {
  for (const char* name : {"a.00", "a.01"}) {
    EventLogFile log(folder / name, EventLogFile::Existing::kRefuse);
    for (int i = 0; i < 3; ++i)
      log.write(i, std::string("C") + std::to_string(i), bytes_of(std::string(name) + "data"));
  }
  const std::string second = read_bytes(folder / "a.01");
  write_bytes(folder / "a.01", second.substr(0, 38) + "rubbish" + second.substr(38));
  std::vector<LogPart> parts;
  for (const auto& path : list_logs({(folder / "a").string()})) parts.push_back({path});
  return parts;
}

struct Seen {
  std::vector<std::string> events;
  std::vector<ArchivePosition> after;
};

Seen read_all(Archive& archive) {
  Seen seen;
  EventHead head;
  std::vector<std::byte> message;
  while (archive.next_head(head)) {
    archive.read_message(message);
    seen.events.push_back(head.channel + '=' +
                          std::string(reinterpret_cast<const char*>(message.data()), message.size()));
    seen.after.push_back(archive.position());
  }
  seen.after.push_back(archive.position());
  return seen;
}

TEST(Archive, GivesTheEventsOfAllLogsInOrder) {
  const TempFolder folder;
  Archive archive(two_logs(folder));
  const Seen seen = read_all(archive);
  EXPECT_EQ(seen.events, (std::vector<std::string>{"C0=a.00data", "C1=a.00data", "C2=a.00data", "C0=a.01data",
                                                   "C1=a.01data", "C2=a.01data"}));
  EXPECT_EQ(seen.after.back().skipped, 7);
  EXPECT_EQ(archive.bytes_done(), archive.bytes_in_all());
}

TEST(Archive, GoesOnFromAnyPositionAsIfItHadNotStopped) {
  const TempFolder folder;
  const auto parts = two_logs(folder);
  Archive whole(parts);
  const Seen want = read_all(whole);
  for (std::size_t i = 0; i < want.events.size(); ++i) {
    Archive rest(parts, want.after[i]);
    const Seen seen = read_all(rest);
    EXPECT_EQ(seen.events, std::vector<std::string>(want.events.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                                                    want.events.end()));
    EXPECT_EQ(seen.after.back().skipped, 7) << i;
    EXPECT_EQ(rest.bytes_done(), rest.bytes_in_all());
  }
}

TEST(Archive, PartsGiveEveryEventOnce) {
  const TempFolder folder;
  const auto parts = two_logs(folder);
  Archive whole(parts);
  const Seen want = read_all(whole);
  // Wherever a file is cut at an event's start.
  for (std::size_t i = 0; i + 1 < want.events.size(); ++i) {
    const ArchivePosition cut = want.after[i];
    std::vector<LogPart> first(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(cut.part) + 1);
    first.back().part.end = cut.offset;
    std::vector<LogPart> second(parts.begin() + static_cast<std::ptrdiff_t>(cut.part), parts.end());
    second.front().part.begin = cut.offset;
    Archive a(first), b(second);
    Seen seen = read_all(a);
    const Seen rest = read_all(b);
    seen.events.insert(seen.events.end(), rest.events.begin(), rest.events.end());
    EXPECT_EQ(seen.events, want.events) << i;
    EXPECT_EQ(seen.after.back().skipped + rest.after.back().skipped, 7) << i;
  }
}

TEST(LogParts, NamesThatAreNoLogs) {
  const TempFolder folder;
  EXPECT_THROW((void)list_logs({(folder / "none").string()}), EventLogError);
  EXPECT_THROW((void)list_logs({folder.path().string()}), EventLogError);
  EXPECT_THROW(Archive({{folder / "none"}}), EventLogError);
}

TEST(EventLogFile, GoesOnBehindWhatCounts) {
  const TempFolder folder;
  const auto write = [](EventLogFile& log, int begin, int end) {
    for (int i = begin; i < end; ++i) log.write(i, "CHANNEL", bytes_of(std::to_string(i)));
  };
  EventLogFile whole(folder / "whole", EventLogFile::Existing::kRefuse);
  write(whole, 0, 6);
  std::int64_t size = 0;
  {
    EventLogFile log(folder / "log", EventLogFile::Existing::kRefuse);
    write(log, 0, 3);
    size = log.size();
    write(log, 9, 12);
  }
  EventLogFile log(folder / "log", size, 3);
  write(log, 3, 6);
  log.sync();
  EXPECT_EQ(read_bytes(folder / "log"), read_bytes(folder / "whole"));
  EXPECT_THROW(EventLogFile(folder / "log", 10'000, 3), EventLogError);
  EXPECT_THROW(EventLogFile(folder / "none", 0, 0), EventLogError);
}

}  // namespace
}  // namespace graspd

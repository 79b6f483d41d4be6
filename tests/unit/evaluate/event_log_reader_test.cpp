// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/log/event_log_reader.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/temp_folder.hpp"

namespace graspd {
namespace {

struct Contents {
  std::vector<std::string> events;  // channel=data
  std::int64_t skipped = 0;
};

Contents contents(const std::filesystem::path& path) {
  EventLogReader reader(path);
  LoggedEvent event;
  Contents result;
  while (reader.next(event))
    result.events.push_back(
        event.channel + '=' +
        std::string(reinterpret_cast<const char*>(event.bytes.data()), event.bytes.size()));
  result.skipped = reader.skipped_bytes();
  return result;
}

Contents contents_of_bytes(const std::string& bytes) {
  const TempFolder folder;
  write_bytes(folder / "a.log", bytes);
  return contents(folder / "a.log");
}

/// Two events, the second with a sync word in its data.
std::string log_bytes() {
  const TempFolder folder;
  const std::string first = "hello", second = std::string("x\xed\xa1\xda\x01y", 6);
  EventLogFile log(folder / "a.log", EventLogFile::Existing::kRefuse);
  log.write(1'700'000'000'000'001, "A", std::as_bytes(std::span(first)));
  log.write(2, "BB", std::as_bytes(std::span(second)));
  return read_bytes(folder / "a.log");
}

const std::vector<std::string> kBoth{"A=hello", std::string("BB=x\xed\xa1\xda\x01y", 9)};

TEST(EventLogReader, ReadsWhatWasWritten) {
  const TempFolder folder;
  write_bytes(folder / "a.log", log_bytes());
  EventLogReader reader(folder / "a.log");
  LoggedEvent event;
  ASSERT_TRUE(reader.next(event));
  EXPECT_EQ(event.recv_utime, 1'700'000'000'000'001);
  EXPECT_EQ(event.channel, "A");
  ASSERT_TRUE(reader.next(event));
  EXPECT_EQ(event.recv_utime, 2);
  EXPECT_FALSE(reader.next(event));
  EXPECT_FALSE(reader.next(event));
  EXPECT_EQ(reader.skipped_bytes(), 0);
  EXPECT_TRUE(is_event_log(folder / "a.log"));
}

TEST(EventLogReader, ALogCutShortAnywhereGivesItsWholeEvents) {
  const std::string bytes = log_bytes();
  const std::size_t first = 28 + 1 + 5;
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const Contents cut = contents_of_bytes(bytes.substr(0, size));
    EXPECT_EQ(cut.events.size(), size < first ? 0u : 1u) << size;
    EXPECT_EQ(cut.skipped, static_cast<std::int64_t>(size < first ? size : size - first)) << size;
  }
}

TEST(EventLogReader, DamagedBytesCostTheirEventAlone) {
  const std::string bytes = log_bytes();
  for (std::size_t i = 0; i < 28; ++i) {
    std::string damaged = bytes;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x5a);
    const Contents found = contents_of_bytes(damaged);
    ASSERT_FALSE(found.events.empty()) << i;
    EXPECT_EQ(found.events.back(), kBoth[1]) << i;
  }
  const Contents between = contents_of_bytes(bytes.substr(0, 34) + "rubbish" + bytes.substr(34));
  EXPECT_EQ(between.events, kBoth);
  EXPECT_EQ(between.skipped, 7);
}

TEST(EventLogReader, LengthsAreNotTrusted) {
  std::string huge = log_bytes();
  for (const char byte : {'\x7f', '\xff'}) {
    for (const std::size_t length_at : {20u, 24u}) {  // of the channel, of the data
      std::string hostile = huge;
      hostile[length_at] = byte;
      const Contents found = contents_of_bytes(hostile);
      ASSERT_EQ(found.events.size(), 1u);
      EXPECT_EQ(found.events[0], kBoth[1]);
    }
  }
}

TEST(EventLogReader, ManySyncWordsAreNoEvents) {
  std::string bytes;
  for (int i = 0; i < 500'000; ++i) bytes += std::string("\xed\xa1\xda\x01", 4);
  const Contents found = contents_of_bytes(bytes);
  EXPECT_TRUE(found.events.empty());
  EXPECT_EQ(found.skipped, 2'000'000);
}

TEST(EventLogReader, RandomBytesAndEventsBetweenThem) {
  std::mt19937 random(7);
  std::string noise(20'000, '\0');
  for (char& c : noise) c = static_cast<char>(random());
  const Contents found = contents_of_bytes(noise + log_bytes() + noise);
  EXPECT_EQ(found.events, kBoth);
  EXPECT_EQ(found.skipped, 40'000);
}

TEST(EventLogReader, FilesThatAreNone) {
  const TempFolder folder;
  EXPECT_THROW(EventLogReader(folder / "none.log"), EventLogError);
  EXPECT_THROW(EventLogReader(folder.path()), EventLogError);
  write_bytes(folder / "empty.log", "");
  EXPECT_TRUE(contents(folder / "empty.log").events.empty());
  EXPECT_FALSE(is_event_log(folder / "empty.log"));
  EXPECT_FALSE(is_event_log(folder / "none.log"));
  EXPECT_FALSE(is_event_log(folder.path()));
}

}  // namespace
}  // namespace graspd

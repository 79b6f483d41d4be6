// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/replay/archive_search.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <optional>

#include "client/replay/player.hpp"
#include "tests/unit/replay/random_log.hpp"

namespace graspd {
namespace {

constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();

/// Steps in proportion to logs of some hundred kilobytes.
constexpr TimeSearchConfig kSmall{
    .disorder_us = 1'000'000, .sample_bytes = 20'000, .most_samples = 8, .narrow_bytes = 4000};

/// Logs one after the other in time, as a rotation leaves them.
struct RandomArchive {
  RandomArchive(std::uint64_t seed, RandomLogConfig config, int logs = 3) : rng(seed) {
    for (int i = 0; i < logs; ++i) {
      const std::filesystem::path path = folder / ("log." + std::to_string(i));
      config.start_utime = end_utime = write_random_log(path, rng, config);
      parts.push_back({path});
    }
  }
  std::int64_t any_time() {
    return static_cast<std::int64_t>(rng.uniform(-0.1, 1.1) * static_cast<double>(end_utime));
  }

  TempFolder folder;
  Rng rng;
  std::vector<LogPart> parts;
  std::int64_t end_utime = 0;
};

void expect_equal_to_a_scan(RandomArchive& archive, const std::string& what) {
  ArchiveSearch search(archive.parts, kSmall);
  for (int i = 0; i < 20; ++i) {
    const std::int64_t from = i == 0 ? kLeast : archive.any_time(), to = i == 1 ? kMost : archive.any_time();
    EXPECT_EQ(events_between(search.stretch(from, to), from, to), events_between(archive.parts, from, to))
        << what << ", from " << from << " to " << to;
  }
  EXPECT_TRUE(search.notes().empty()) << what;
}

TEST(ArchiveSearch, FindsWhatAScanFindsInRandomLogs) {
  for (std::uint64_t seed = 0; seed < 25; ++seed) {
    RandomArchive archive(seed,
                          {.events = static_cast<int>(2 + 17 * seed), .most_bytes = 2 + 200 * (seed % 20)});
    expect_equal_to_a_scan(archive, "seed " + std::to_string(seed));
  }
}

TEST(ArchiveSearch, FindsWhatAScanFindsWhereTimesAreALittleOutOfOrder) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    RandomArchive archive(seed, {.most_step_us = 300'000, .most_early_us = 999'999});
    expect_equal_to_a_scan(archive, "seed " + std::to_string(seed));
  }
}

TEST(ArchiveSearch, FindsWhatAScanFindsInDamagedLogs) {
  for (std::uint64_t seed = 0; seed < 25; ++seed) {
    RandomArchive archive(seed, {.damages = 1 + static_cast<int>(seed)});
    expect_equal_to_a_scan(archive, "seed " + std::to_string(seed));
  }
}

TEST(ArchiveSearch, LeavesMostOfALogUnread) {
  RandomArchive archive(1, {.events = 1000}, 2);
  ArchiveSearch search(archive.parts, kSmall);
  const std::int64_t all = bytes_of_parts(archive.parts);
  for (int i = 1; i < 10; ++i) {
    const std::int64_t from = i * archive.end_utime / 10;
    EXPECT_LT(bytes_of_parts(search.stretch(from, from + 1'000'000)), all / 50) << i;
  }
  EXPECT_EQ(bytes_of_parts(search.stretch(kLeast, kMost)), all);
  EXPECT_EQ(bytes_of_parts(search.stretch(2 * archive.end_utime, kMost)), 0);
  EXPECT_EQ(bytes_of_parts(search.stretch(kLeast, -5'000'000)), 0);
}

TEST(ArchiveSearch, ALogWhoseTimesGoBackwardsIsReadWhole) {
  RandomArchive archive(2, {.events = 300}, 1);
  // The clock was put back by half of what was recorded.
  write_random_log(archive.folder / "second", archive.rng,
                   {.events = 300, .start_utime = archive.end_utime / 2});
  const std::filesystem::path path = archive.parts[0].path;
  write_bytes(path, read_bytes(path) + read_bytes(archive.folder / "second"));
  ArchiveSearch search(archive.parts, kSmall);
  const std::int64_t from = archive.end_utime * 6 / 10, to = archive.end_utime * 7 / 10;
  EXPECT_EQ(events_between(search.stretch(from, to), from, to), events_between(archive.parts, from, to));
  ASSERT_EQ(search.notes().size(), 1u);
  EXPECT_NE(search.notes()[0].find("log.0: times go backwards"), std::string::npos) << search.notes()[0];
}

TEST(ArchiveSearch, LogsInAnyOrderAreEachSearched) {
  RandomArchive archive(3, {.events = 300}, 4);
  std::swap(archive.parts[0], archive.parts[3]);
  std::swap(archive.parts[0], archive.parts[1]);
  expect_equal_to_a_scan(archive, "shuffled");
}

TEST(ArchiveSearch, PartsOfLogsStayWhatTheyAre) {
  RandomArchive archive(4, {.events = 300}, 1);
  EventLogReader reader(archive.parts[0].path);
  EventHead head;
  for (int i = 0; i < 50; ++i) ASSERT_TRUE(reader.next_head(head));
  archive.parts[0].part.begin = head.position;
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(reader.next_head(head));
  archive.parts[0].part.end = head.position;
  expect_equal_to_a_scan(archive, "a part");
}

/// Bytes that this process has read from files; nothing where the kernel does not count.
std::optional<std::int64_t> bytes_read() {
  std::ifstream file("/proc/self/io");
  std::string name;
  std::int64_t bytes = 0;
  return file >> name >> bytes && name == "rchar:" ? std::optional(bytes) : std::nullopt;
}

TEST(ArchiveSearch, ReadsWhatIsNoEventAFewTimesAtMost) {
  if (!bytes_read()) GTEST_SKIP() << "/proc/self/io cannot be read";
  RandomArchive archive(6, {.events = 100}, 1);
  const std::filesystem::path path = archive.parts[0].path;
  // Between the events, and behind them.
  constexpr std::int64_t kHole = 10'000'000;
  const std::string events = read_bytes(path), hole(kHole, '\0');
  write_random_log(archive.folder / "later", archive.rng, {.events = 100, .start_utime = archive.end_utime});
  write_bytes(path, events + hole + read_bytes(archive.folder / "later") + hole);
  TimeSearchConfig many = kSmall;
  many.most_samples = 1'000'000;
  const std::int64_t before = *bytes_read();
  for (int i = 0; i < 5; ++i) {
    ArchiveSearch search(archive.parts, many);
    (void)search.stretch(archive.end_utime / 2, archive.end_utime * 5 / 4);
  }
  EXPECT_LT(*bytes_read() - before, 5 * 6 * 2 * kHole);
}

TEST(ArchiveSearch, WhatIsNoLogIsReadWhole) {
  const TempFolder folder;
  write_bytes(folder / "empty", "");
  write_bytes(folder / "noise", std::string(100'000, 'x'));
  const std::vector<LogPart> parts{{folder / "empty"}, {folder / "noise"}};
  ArchiveSearch search(parts, kSmall);
  EXPECT_EQ(bytes_of_parts(search.stretch(5, 6)), 100'000);
  EXPECT_THROW(ArchiveSearch({{folder / "none"}}), EventLogError);
}

TEST(Player, SeeksAsByReadingAllHeaders) {
  RandomArchive archive(5, {.events = 2000, .damages = 5});
  const Player::TimePoint now;
  Player search(archive.parts, "GRASPD.*", 1, now), scan(archive.parts, "GRASPD.*", 1, now, true);
  for (int i = 0; i < 40; ++i) {
    const std::string command = "seek " + std::to_string(1e-6 * static_cast<double>(archive.any_time()));
    ASSERT_TRUE(search.obey(command, now) && scan.obey(command, now));
    for (int events = 0; events < 3; ++events) {
      ASSERT_EQ(search.ended(), scan.ended()) << command;
      if (scan.ended()) break;
      const LoggedEvent a = search.take(), b = scan.take();
      EXPECT_EQ(a.recv_utime, b.recv_utime) << command;
      EXPECT_EQ(a.bytes, b.bytes) << command;
    }
  }
}

}  // namespace
}  // namespace graspd

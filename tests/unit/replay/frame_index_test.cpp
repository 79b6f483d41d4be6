// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/replay/frame_index.hpp"

#include <gtest/gtest.h>

#include "tests/unit/replay/random_log.hpp"

namespace graspd {
namespace {

bool is_cloud(const std::string& channel) {
  return channel == "GRASPD_CLOUD";
}

/// What graspd-replay chooses of the parts: from behind frame first - 1 up to frame end - 1.
std::vector<FoundEvent> chosen(const std::vector<LogPart>& parts, std::int64_t frame, std::int64_t first,
                               std::int64_t end) {
  std::vector<FoundEvent> events;
  for (const FoundEvent& event : events_between(parts, -1'000'000'000, 1'000'000'000'000)) {
    if (frame >= first && frame < end) events.push_back(event);
    if (is_cloud(std::get<3>(event))) ++frame;
  }
  return events;
}

/// 60 MB of logs, so that there are several blocks in each; damaged.
std::vector<LogPart> large_logs(const TempFolder& folder) {
  Rng rng(1);
  std::vector<LogPart> parts;
  for (int i = 0; i < 2; ++i) {
    const std::filesystem::path path = folder / ("log." + std::to_string(i));
    write_random_log(path, rng, {.events = 60, .most_bytes = 1'000'000, .damages = 4});
    parts.push_back({path});
  }
  return parts;
}

TEST(FrameIndex, FindsTheFramesThatCountingFinds) {
  const TempFolder folder;
  const auto parts = large_logs(folder);
  const FrameIndex made(parts);
  made.save(folder / "index");
  const auto index = FrameIndex::load(folder / "index", parts);
  ASSERT_TRUE(index);
  bool narrower = false, later = false;
  for (std::int64_t first = 0; first < 45; first += 3) {
    for (const std::int64_t end : {first, first + 1, first + 7, std::int64_t{1000}}) {
      const auto found = index->stretch(first, end, is_cloud);
      EXPECT_EQ(chosen(found.parts, found.frames_before, first, end), chosen(parts, 0, first, end))
          << first << ':' << end;
      narrower |= bytes_of_parts(found.parts) < bytes_of_parts(parts) / 2;
      later |= found.frames_before > 0;
    }
  }
  EXPECT_TRUE(narrower && later);
  EXPECT_LT(std::filesystem::file_size(folder / "index"), 1000u);
}

TEST(FrameIndex, BelongsToItsLogs) {
  const TempFolder folder;
  Rng rng(2);
  write_random_log(folder / "a", rng, {.events = 5});
  write_random_log(folder / "b", rng, {.events = 5});
  FrameIndex({{folder / "a"}}).save(folder / "index");
  EXPECT_TRUE(FrameIndex::load(folder / "index", {{folder / "a"}}));
  EXPECT_FALSE(FrameIndex::load(folder / "index", {{folder / "b"}}));
  EXPECT_FALSE(FrameIndex::load(folder / "index", {{folder / "a"}, {folder / "b"}}));
  EXPECT_FALSE(FrameIndex::load(folder / "none", {{folder / "a"}}));
  write_bytes(folder / "a", read_bytes(folder / "a") + "more");
  EXPECT_FALSE(FrameIndex::load(folder / "index", {{folder / "a"}}));
}

TEST(FrameIndex, WhatIsNoIndexIsRefused) {
  const TempFolder folder;
  Rng rng(3);
  write_random_log(folder / "a", rng, {.events = 5});
  const std::vector<LogPart> parts{{folder / "a"}};
  FrameIndex(parts).save(folder / "index");
  const std::string text = read_bytes(folder / "index");
  for (std::size_t size = 0; size + 2 < text.size(); size += 5) {
    write_bytes(folder / "index", text.substr(0, size));
    EXPECT_THROW((void)FrameIndex::load(folder / "index", parts), std::runtime_error) << size;
  }
  for (const char* blocks :
       {"[[1, 0, [1]]]", "[[0, -1, [1]]]", "[[0, 99999999, [1]]]", "[[0, 0, [-1]]]", "[[0, 0, [1, 1, 1]]]",
        "[[0, 5, []], [0, 5, []]]", "[[0]]", "7", "[[0, 0, 7]]"}) {
    std::string other = text;
    const auto begin = other.find("\"blocks\":") + 9;
    other.replace(begin, other.find("]]]", begin) + 3 - begin, blocks);
    write_bytes(folder / "index", other);
    EXPECT_THROW((void)FrameIndex::load(folder / "index", parts), std::runtime_error) << blocks;
  }
}

}  // namespace
}  // namespace graspd

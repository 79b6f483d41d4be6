// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/replay/selection.hpp"

#include <gtest/gtest.h>

#include "client/replay/channel_table.hpp"
#include "service/config/config_error.hpp"
#include "tests/support/temp_folder.hpp"

namespace graspd {
namespace {

std::vector<LogPart> a_log(const TempFolder& folder) {
  EventLogFile log(folder / "log", EventLogFile::Existing::kOverwrite);
  log.write(5'000'000, "C", {});
  log.write(9'000'000, "C", {});
  return {{folder / "log"}};
}

TEST(Selection, TimesAreRelativeToTheFirstEventOrAbsolute) {
  const TempFolder folder;
  const Selection s = parse_selection("1.5", "@8", "", a_log(folder));
  EXPECT_EQ(s.from_utime, 6'500'000);
  EXPECT_EQ(s.to_utime, 8'000'000);
  EXPECT_TRUE(s.has_time(6'500'000));
  EXPECT_FALSE(s.has_time(8'000'000));
  EXPECT_TRUE(s.has_frame(0));
}

TEST(Selection, FramesAreHalfOpen) {
  const TempFolder folder;
  const auto frames = [&](const char* text) { return parse_selection("", "", text, a_log(folder)); };
  EXPECT_FALSE(frames("2:4").has_frame(1));
  EXPECT_TRUE(frames("2:4").has_frame(3));
  EXPECT_FALSE(frames("2:4").has_frame(4));
  EXPECT_TRUE(frames("2:").has_frame(1'000'000));
  EXPECT_TRUE(frames(":2").has_frame(1));
  for (const char* wrong : {"3", "a:b", "1:2:3", "1.5:2", "1 :2"})
    EXPECT_THROW((void)frames(wrong), ConfigError) << wrong;
  for (const char* wrong : {"@", "soon", "1e400", "nan", "@1e300"})
    EXPECT_THROW((void)parse_selection(wrong, "", "", a_log(folder)), ConfigError) << wrong;
}

TEST(ChannelTable, KnowsCloudsWhatIsKeptAndTheRest) {
  const SystemClock clock;
  ServiceConfig config;
  config.sources[0].channel = "CAMERA_.*";
  ChannelTable table(config, "NOTES|GRASPD_.*|CAMERA_2", clock);
  EXPECT_TRUE(table.find("CAMERA_1").processor);
  EXPECT_FALSE(table.find("CAMERA_1").keep);
  EXPECT_TRUE(table.find("CAMERA_2").keep);
  EXPECT_TRUE(table.find("NOTES").keep);
  EXPECT_FALSE(table.find("NOTES").processor);
  EXPECT_TRUE(table.find("GRASPD_STATUS").keep);
  EXPECT_FALSE(table.find("GRASPD_HANDLES").keep) << "the output's own lists go there";
  EXPECT_FALSE(table.find("OTHER").keep);
  EXPECT_THROW(ChannelTable(config, "(", clock), ConfigError);
}

TEST(ChannelTable, StaysBoundedWhateverNamesThereAre) {
  const SystemClock clock;
  ChannelTable table(ServiceConfig(), "KEPT", clock);
  const ChannelUse* camera = &table.find("GRASPD_CLOUD");
  const ChannelUse* kept = &table.find("KEPT");
  for (int i = 0; i < 20'000; ++i) EXPECT_FALSE(table.find(std::to_string(i)).keep);
  EXPECT_EQ(&table.find("GRASPD_CLOUD"), camera);
  EXPECT_EQ(&table.find("KEPT"), kept);
}

}  // namespace
}  // namespace graspd

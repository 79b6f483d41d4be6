// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/draw/drawn_frame.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "client/detect/file_detection.hpp"
#include "client/log/event_log_file.hpp"
#include "client/simulate/simulation.hpp"
#include "service/transport/cloud_encoder.hpp"
#include "service/transport/handle_list_codec.hpp"
#include "service/transport/segmentation_codec.hpp"
#include "tests/support/temp_folder.hpp"

namespace graspd {
namespace {

PointCloud cloud() {
  SimulationConfig config;
  config.camera = {320, 240, 262.5, 262.5, 159.5, 119.5};
  config.sensor = *sensor_model("kinect");
  return to_cloud(Simulation(config).frame(0)).cloud;
}

struct Found {
  PictureFrame frame;
  std::vector<std::string> problems;
};

Found find(const std::filesystem::path& path, std::size_t number = 0) {
  Found found;
  found.frame = find_drawn_frame({path.string()}, number, SourceConfig{}, {}, found.problems);
  return found;
}

TEST(DrawnFrame, AFileIsDetectedIn) {
  const TempFolder folder;
  save_pcd(folder / "a.pcd", {cloud(), {}, {}});
  const Found found = find(folder / "a.pcd");
  const handle_list_t expected = detect_in_cloud(cloud(), "a", 0, SourceConfig{}).list;
  ASSERT_GT(expected.num_handles, 0);
  ASSERT_EQ(found.frame.list.num_handles, expected.num_handles);
  EXPECT_EQ(found.frame.list.handles[0].score, expected.handles[0].score);
  EXPECT_EQ(found.frame.segmentation.num_segments, expected.num_segments);
  EXPECT_EQ(found.frame.title, "a");
  EXPECT_TRUE(found.problems.empty());
}

TEST(DrawnFrame, BadFilesAreLeftOutAndSaid) {
  const TempFolder folder;
  write_bytes(folder / "a.pcd", "nonsense");
  write_bytes(folder / "b.pcd",
              "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 100000000\nHEIGHT 1\n");
  save_pcd(folder / "c.pcd", {cloud(), {}, {}});
  const Found found = find(folder.path());
  EXPECT_EQ(found.frame.title, "c");
  EXPECT_EQ(found.problems.size(), 2u);
  EXPECT_THROW((void)find(folder.path(), 1), std::runtime_error);
  EXPECT_THROW((void)find(folder / "none.pcd"), CloudFileError);
}

TEST(DrawnFrame, ALogsOwnAnswersAreDrawn) {
  const TempFolder folder;
  Handle handle;
  handle.position = {0.1f, 0.2f, 0.7f};
  handle.width_m = 0.03f;
  Detection detection;
  detection.handles = {handle};
  HandleListHeader header;
  header.utime = 1;
  header.seq = 6;
  header.source_channel = "CLOUD";
  auto other = header;
  other.source_channel = "OTHER";
  const std::vector<std::uint32_t> colors(cloud().size(), 0x123456);
  {
    EventLogFile log(folder / "run.log", EventLogFile::Existing::kRefuse);
    log.write(1, "CLOUD", encode(make_point_cloud({1, 5, "camera"}, cloud(), colors)));
    log.write(2, "NOISE", std::vector<std::byte>(100));
    log.write(3, "CLOUD", encode(make_point_cloud({1, 6, "camera"}, cloud())));
    log.write(4, "HANDLES", encode(make_handle_list(other, {}, {}, Eigen::Isometry3f::Identity())));
    log.write(5, "HANDLES", encode(make_handle_list(header, {}, detection, Eigen::Isometry3f::Identity())));
  }
  const Found first = find(folder / "run.log", 0);
  EXPECT_EQ(first.frame.title, "run.log#5");
  EXPECT_EQ(first.frame.cloud.rgb, colors);
  EXPECT_GT(first.frame.list.num_handles, 1) << "nothing was logged: found by the method";
  const Found second = find(folder / "run.log", 1);
  EXPECT_EQ(second.frame.title, "run.log#6");
  EXPECT_TRUE(second.frame.cloud.rgb.empty());
  ASSERT_EQ(second.frame.list.num_handles, 1);
  EXPECT_EQ(second.frame.list.handles[0].position[0], double{0.1f});
  EXPECT_GT(second.frame.segmentation.num_points, 0);
  EXPECT_THROW((void)find(folder / "run.log", 2), std::runtime_error);
}

TEST(DrawnFrame, ADamagedLogGivesWhatIsWhole) {
  const TempFolder folder;
  {
    EventLogFile log(folder / "run.log", EventLogFile::Existing::kRefuse);
    auto bad = encode(make_point_cloud({1, 4, "camera"}, cloud()));
    bad.resize(bad.size() / 2);
    log.write(1, "CLOUD", bad);
    log.write(2, "CLOUD", encode(make_point_cloud({1, 5, "camera"}, cloud())));
  }
  write_bytes(folder / "cut.log",
              read_bytes(folder / "run.log") + std::string("\xed\xa1\xda\x01 and no more"));
  const Found found = find(folder / "cut.log");
  EXPECT_EQ(found.frame.title, "cut.log#5");
  EXPECT_EQ(found.problems.size(), 2u);
}

}  // namespace
}  // namespace graspd

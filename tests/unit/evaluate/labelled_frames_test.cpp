// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/labelled_frames.hpp"

#include <gtest/gtest.h>

#include "client/log/event_log_file.hpp"
#include "service/transport/cloud_encoder.hpp"
#include "service/transport/handle_list_codec.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/unit/evaluate/labelled_scene.hpp"

namespace graspd {
namespace {

struct Visited {
  std::vector<LabelledFrame> frames;
  std::vector<std::string> problems;
};

Visited visited(const std::vector<std::string>& arguments) {
  Visited result;
  for_each_frame(
      arguments,
      [&](LabelledFrame& frame) {
        result.frames.push_back(std::move(frame));
        return true;
      },
      [&](const std::string& line) { result.problems.push_back(line); });
  return result;
}

std::vector<std::byte> cloud_message(std::int64_t seq, const LabelledCloud& cloud) {
  return encode(make_point_cloud({1, seq, "camera"}, cloud.cloud, {}, cloud.label));
}

std::vector<std::byte> answer(std::int64_t seq) {
  HandleListHeader header;
  header.seq = seq;
  header.source_channel = "CLOUD";
  Detection detection;
  detection.handles = {on_box()};
  return encode(make_handle_list(header, {}, detection, Eigen::Isometry3f::Identity()));
}

TEST(LabelledFrames, FilesInFoldersByName) {
  const TempFolder folder;
  const LabelledCloud cloud = labelled(box_on_table());
  for (const char* name : {"f10.pcd", "f9.pcd"}) save_pcd(folder / name, cloud);
  const Visited found = visited({folder.path().string()});
  ASSERT_EQ(found.frames.size(), 2u);
  EXPECT_EQ(found.frames[0].name, "f9");
  EXPECT_EQ(found.frames[1].name, "f10");
  EXPECT_FALSE(found.frames[0].seq);
  EXPECT_EQ(found.frames[0].cloud.label, cloud.label);
}

TEST(LabelledFrames, ABrokenFileCostsALine) {
  const TempFolder folder;
  write_bytes(folder / "a.pcd", "nonsense");
  save_pcd(folder / "b.pcd", labelled(box_on_table()));
  const Visited found = visited({folder.path().string()});
  EXPECT_EQ(found.frames.size(), 1u);
  ASSERT_EQ(found.problems.size(), 1u);
  EXPECT_NE(found.problems[0].find("a.pcd"), std::string::npos);
  EXPECT_THROW(visited({(folder / "none").string()}), CloudFileError);
}

TEST(LabelledFrames, LogsWithWhatWasAnswered) {
  const TempFolder folder;
  const LabelledCloud cloud = labelled(box_on_table());
  {
    EventLogFile log(folder / "run.log", EventLogFile::Existing::kRefuse);
    log.write(1, "CLOUD", cloud_message(5, cloud));
    log.write(2, "OTHER", cloud_message(6, cloud));
    log.write(3, "HANDLES", answer(5));
    log.write(4, "HANDLES", answer(6));  // to CLOUD, not to OTHER
    log.write(5, "TEXT", std::vector<std::byte>(3));
  }
  Visited found = visited({(folder / "run.log").string()});
  ASSERT_EQ(found.frames.size(), 2u);
  EXPECT_EQ(found.frames[0].name, "run.log#5");
  EXPECT_EQ(found.frames[0].seq, 5);
  EXPECT_EQ(found.frames[0].cloud.label, cloud.label);
  ASSERT_TRUE(found.frames[0].logged_handles);
  ASSERT_EQ(found.frames[0].logged_handles->size(), 1u);
  EXPECT_TRUE(found.frames[0].logged_handles->front().rotation.isApprox(on_box().rotation, 1e-5f));
  EXPECT_EQ(found.frames[0].logged_handles->front().width_m, on_box().width_m);
  EXPECT_FALSE(found.frames[1].logged_handles);
  EXPECT_TRUE(found.problems.empty());
  // Cut short.
  const std::string bytes = read_bytes(folder / "run.log");
  write_bytes(folder / "cut.log", bytes.substr(0, bytes.size() / 2));
  found = visited({(folder / "cut.log").string()});
  EXPECT_EQ(found.problems.size(), 1u);
}

TEST(LabelledFrames, CloudsThatAreRefusedCostALine) {
  const TempFolder folder;
  auto message = cloud_message(1, labelled(box_on_table()));
  message.resize(message.size() - 1);
  {
    EventLogFile log(folder / "run.log", EventLogFile::Existing::kRefuse);
    log.write(1, "CLOUD", message);
  }
  const Visited found = visited({(folder / "run.log").string()});
  EXPECT_TRUE(found.frames.empty());
  ASSERT_EQ(found.problems.size(), 1u);
  EXPECT_NE(found.problems[0].find("CLOUD"), std::string::npos);
}

}  // namespace
}  // namespace graspd

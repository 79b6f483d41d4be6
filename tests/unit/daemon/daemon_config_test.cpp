// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// A running daemon takes another configuration: by reload, and by messages on the control channel.
#include <gtest/gtest.h>

#include <string>

#include "service/transport/control_codec.hpp"
#include "tests/unit/daemon/running_daemon.hpp"

namespace graspd {
namespace {

using namespace std::chrono_literals;

class DaemonConfigTest : public RunningDaemon {
 protected:
  /// Starts with what stands for the service file.
  void start_with(const std::string& file) {
    file_ = file;
    const auto load = [this](const std::string& overrides) {
      ConfigLayers layers;
      layers.threads = 2;
      layers.overrides = merge_overrides(file_, overrides);
      return load_layers(layers);
    };
    start(load(""), load);
  }

  /// The status that answers the command.
  status_t control(std::int8_t command, const std::string& text = "") {
    const std::int64_t id = ++id_;
    send("GRASPD_CONTROL", encode(control_t{0, id, command, text}));
    run_until([&] { return !statuses_.empty() && statuses_.back().control_id == id; });
    return statuses_.back();
  }
  status_t set(const std::string& text) { return control(control_t::SET, text); }

  handle_list_t answer(const std::string& channel, const Bytes& message) {
    const std::size_t before = answers_.size();
    send(channel, message);
    run_until_answers(before + 1);
    return answers_.back();
  }
  [[nodiscard]] std::vector<std::string> channels() const {
    std::vector<std::string> names;
    for (const source_status_t& source : statuses_.back().sources) names.push_back(source.channel);
    return names;
  }

  std::string file_;
  std::int64_t id_ = 0;
};

constexpr const char* kOpen = "lcm: {control_channel: GRASPD_CONTROL}\n";

TEST_F(DaemonConfigTest, AReloadIsTakenWholeOrNotAtAll) {
  start_with("detect: {downsample: {leaf_size_m: 0.003}}");
  EXPECT_EQ(answer("GRASPD_CLOUD", cloud_message(1, box_on_table())).config_revision, 1);
  file_ = "detect: {downsample: {leaf_size_m: 0.004}}";
  daemon_->reload();
  handle_list_t list = answer("GRASPD_CLOUD", cloud_message(2, box_on_table()));
  EXPECT_EQ(list.config_revision, 2);
  EXPECT_FLOAT_EQ(static_cast<float>(list.voxel_size), 0.004f);
  file_ = "{workers: 3, detect: {downsample: {leaf_size_m: 7}}}";
  daemon_->reload();
  list = answer("GRASPD_CLOUD", cloud_message(3, box_on_table()));
  EXPECT_EQ(list.config_revision, 2);
  EXPECT_FLOAT_EQ(static_cast<float>(list.voxel_size), 0.004f);
  run_until_status();
  EXPECT_NE(statuses_.back().config_error.find("leaf_size_m: out of range"), std::string::npos);
  EXPECT_TRUE(logged("event=config_refused cause=reload"));
  file_ = "";
  daemon_->reload();
  run_until_status();
  EXPECT_EQ(statuses_.back().config_error, "");
  EXPECT_EQ(statuses_.back().config_revision, 3);
}

TEST_F(DaemonConfigTest, ControlMessagesSetUndoAndReset) {
  start_with(kOpen);
  status_t status =
      set("sources: [{name: camera, detect: {downsample: {leaf_size_m: 0.005}, neighborhoods: {radius_m: "
          "0.015}}}]");
  EXPECT_EQ(status.config_error, "");
  EXPECT_EQ(status.config_revision, 2);
  EXPECT_NE(status.overrides.find("0.005"), std::string::npos);
  EXPECT_FLOAT_EQ(static_cast<float>(answer("GRASPD_CLOUD", cloud_message(1, box_on_table())).voxel_size),
                  0.005f);
  status = set("sources: [{name: camera, gripper: robotiq_2f_85}]");
  const handle_list_t list = answer("GRASPD_CLOUD", cloud_message(2, box_on_table()));
  EXPECT_EQ(list.gripper.name, "robotiq_2f_85");
  EXPECT_FLOAT_EQ(static_cast<float>(list.voxel_size), 0.005f);
  status = control(control_t::UNDO);
  EXPECT_EQ(status.config_revision, 4);
  EXPECT_EQ(answer("GRASPD_CLOUD", cloud_message(3, box_on_table())).gripper.name, "paper_80mm");
  status = control(control_t::RESET);
  EXPECT_EQ(status.overrides, "");
  EXPECT_FLOAT_EQ(static_cast<float>(answer("GRASPD_CLOUD", cloud_message(4, box_on_table())).voxel_size),
                  0.003f);
}

TEST_F(DaemonConfigTest, ARefusedControlMessageChangesNothingAndSaysWhy) {
  start_with(kOpen);
  const status_t status = set("detect: {smoothness: {theta_low: 5}}");
  EXPECT_NE(status.config_error.find("theta_low_deg"), std::string::npos) << status.config_error;
  EXPECT_EQ(status.config_revision, 1);
  EXPECT_EQ(status.overrides, "");
  EXPECT_EQ(control(control_t::UNDO).config_error, "nothing to undo");
  send("GRASPD_CONTROL", Bytes(17));
  send("GRASPD_CONTROL", cloud_message(1, box_on_table()));
  run_until([&] { return logged("event=control_refused"); });
  EXPECT_EQ(control(control_t::RELOAD).config_error, "");
  EXPECT_TRUE(answers_.empty()) << "a cloud on the control channel is no cloud";
}

TEST_F(DaemonConfigTest, AnIdThatComesAgainIsARepetition) {
  start_with(kOpen);
  set("workers: 2");
  set("threads: 1");
  const Bytes undo = encode(control_t{0, 77, control_t::UNDO, ""});
  for (int i = 0; i < 3; ++i) send("GRASPD_CONTROL", undo);
  run_until([&] { return !statuses_.empty() && statuses_.back().control_id == 77; });
  run_until_status();
  EXPECT_EQ(statuses_.back().config_revision, 4) << "undone once";
}

TEST_F(DaemonConfigTest, NobodyIsListenedToUnlessThatIsConfigured) {
  start_with("");
  send("GRASPD_CONTROL", encode(control_t{0, 1, control_t::SET, "workers: 1"}));
  run_until_status();
  run_until_status();
  EXPECT_EQ(statuses_.back().control_id, 0);
}

TEST_F(DaemonConfigTest, FramesInWorkEndWithWhatTheyBeganWith) {
  start_with("{watchdog_s: 0, sources: [{name: camera, policy: all}]}");
  hold_frame(0);
  send_and_step(1);
  file_ =
      "{watchdog_s: 0, sources: [{name: camera, policy: all, detect: {downsample: {leaf_size_m: 0.004}}}]}";
  daemon_->reload();
  send_and_step(2);
  clock_.release();
  run_until_answers(3);
  for (const std::size_t before : {0u, 1u})
    EXPECT_FLOAT_EQ(static_cast<float>(answers_[before].voxel_size), 0.003f);
  EXPECT_FLOAT_EQ(static_cast<float>(answers_[2].voxel_size), 0.004f);
  EXPECT_EQ(answers_[2].config_revision, 2);
}

TEST_F(DaemonConfigTest, SourcesComeAndGo) {
  start_with("sources: [{name: a, channel: A}, {name: b, channel: B}]");
  (void)answer("A", cloud_message(1, PointCloud{}));
  (void)answer("B", cloud_message(1, PointCloud{}));
  file_ = "sources: [{name: c, channel: C, handles_channel: C_HANDLES}, {name: b, channel: B}]";
  daemon_->reload();
  run_until_status();
  EXPECT_EQ(channels(), (std::vector<std::string>{"GRASPD_CLOUD", "C", "B"}));
  EXPECT_EQ(statuses_.back().sources[2].received, 1) << "counts go on";
  send("A", cloud_message(2, PointCloud{}));
  EXPECT_EQ(answer("C", cloud_message(3, PointCloud{})).source_channel, "C");
  EXPECT_EQ(answer("B", cloud_message(4, PointCloud{})).source_channel, "B");
  file_ = "sources: [{name: a, channel: A}]";
  daemon_->reload();
  EXPECT_EQ(answer("A", cloud_message(5, PointCloud{})).seq, 5);
  for (const handle_list_t& list : answers_) EXPECT_NE(list.seq, 2) << "nobody's channel then";
}

TEST_F(DaemonConfigTest, FramesThatLoseTheirPlaceAreAnswered) {
  start_with("{watchdog_s: 0, workers: 1, sources: [{name: camera, channel: GRASPD_CLOUD, policy: all}]}");
  hold_frame(0);
  for (std::int64_t seq = 1; seq < 6; ++seq) send_and_step(seq);
  file_ = "{watchdog_s: 0, workers: 1, sources: [{name: camera, channel: GRASPD_CLOUD, policy: latest}]}";
  daemon_->reload();
  file_ = "{watchdog_s: 0, workers: 1, sources: [{name: camera, channel: OTHER}]}";
  daemon_->reload();
  clock_.release();
  run_until_answers(6);
  EXPECT_EQ(answered_seqs(), numbers_to(6));
  EXPECT_EQ(answers_[0].status, +handle_list_t::OK);
  for (std::size_t i = 1; i < 6; ++i) EXPECT_EQ(answers_[i].status_text, "the configuration has changed");
  EXPECT_EQ(answer("OTHER", cloud_message(9, PointCloud{})).seq, 9);
}

TEST_F(DaemonConfigTest, AChannelMayPassFromOneSourceToAnother) {
  start_with("sources: [{name: all, channel: CAM_.*, handles_channel: ALL_HANDLES}]");
  EXPECT_EQ(answer("CAM_1", cloud_message(1, PointCloud{})).frame_name, "camera");
  file_ =
      "sources: [{name: one, channel: CAM_1, sensor_pose: {frame_name: base}}, "
      "{name: all, channel: CAM_.*, handles_channel: ALL_HANDLES}]";
  daemon_->reload();
  EXPECT_EQ(answer("CAM_1", cloud_message(2, PointCloud{})).frame_name, "base");
  EXPECT_EQ(answer("CAM_2", cloud_message(3, PointCloud{})).frame_name, "camera");
  receive_rest();
  EXPECT_EQ(answers_.size(), 3u) << "each answered once";
}

TEST_F(DaemonConfigTest, WhatHoldsFromTheStartStaysAndIsTold) {
  start_with("workers: 2");
  file_ = "{workers: 5, lcm: {url: \"udpm://239.1.1.1:7\"}}";
  daemon_->reload();
  run_until_status();
  EXPECT_EQ(statuses_.back().config_revision, 2);
  EXPECT_EQ(statuses_.back().num_workers, 2);
  EXPECT_TRUE(logged("event=restart_needed keys=workers,lcm.url"));
}

TEST_F(DaemonConfigTest, AThousandReloadsUnderTraffic) {
  start_with(kOpen);
  constexpr std::int64_t kFrames = 200;
  for (std::int64_t seq = 0; seq < kFrames; ++seq) {
    file_ = std::string(kOpen) + "sources: [{name: camera, policy: " + (seq % 2 == 0 ? "all" : "latest") +
            "}, {name: x, channel: X" + std::to_string(seq % 7) + "}]";
    for (int i = 0; i < 5; ++i) daemon_->reload();
    send("GRASPD_CLOUD", cloud_message(seq, uniform_cloud(50, 0.5f)));
    daemon_->step();
  }
  run_until_answers(kFrames);
  EXPECT_EQ(answered_seqs(), numbers_to(kFrames));
  run_until_status();
  EXPECT_EQ(statuses_.back().config_revision, 1 + 5 * kFrames);
  EXPECT_EQ(statuses_.back().num_sources, 2);
}

}  // namespace
}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "service/config/service_config.hpp"
#include "tests/support/temp_folder.hpp"

namespace graspd {
namespace {

constexpr const char* kFile = R"(
workers: 3
detect: {smoothness: {theta_low_deg: 5}}
sources:
  - {name: left, channel: LEFT, gripper: franka_hand}
  - {name: right, channel: RIGHT, detect: {smoothness: {theta_high_deg: 20}}}
)";

class ConfigLayersTest : public testing::Test {
 protected:
  ConfigLayersTest() { layers_.file = folder_.write("graspd.yaml", kFile); }

  ServiceConfig with(const std::string& overrides) {
    layers_.overrides = overrides;
    return load_layers(layers_);
  }
  std::string error_with(const std::string& overrides) {
    try {
      (void)with(overrides);
      return {};
    } catch (const ConfigError& error) {
      return error.what();
    }
  }

  const TempFolder folder_;
  ConfigLayers layers_;
};

TEST_F(ConfigLayersTest, NothingOnTopIsTheFile) {
  EXPECT_EQ(print(with("")), print(load_service_config(layers_.file)));
  EXPECT_EQ(print(load_layers({})), print(ServiceConfig{}));
}

TEST_F(ConfigLayersTest, TheCommandLineIsOnTopOfTheFileAndOverridesOnTopOfBoth) {
  layers_.workers = 5;
  layers_.threads = 2;
  layers_.lcm_url = "memq://";
  layers_.gripper = "robotiq_2f_85";
  const ServiceConfig config = with("{threads: 7, sources: [{name: right, gripper: schunk_wsg_50}]}");
  EXPECT_EQ(config.workers, 5);
  EXPECT_EQ(config.threads, 7);
  EXPECT_EQ(config.lcm.url, "memq://");
  EXPECT_EQ(config.sources[0].gripper.installed_name, "robotiq_2f_85");
  EXPECT_EQ(config.sources[1].gripper.installed_name, "schunk_wsg_50");
}

TEST_F(ConfigLayersTest, OverridesChangeWhatTheyNameAndNothingElse) {
  const ServiceConfig config = with(
      "{detect: {smoothness: {edge_share: 0.3}}, sources: [{name: right, detect: {smoothness: "
      "{theta_low_deg: 6}}}]}");
  ASSERT_EQ(config.sources.size(), 2u);
  for (const SourceConfig& source : config.sources) EXPECT_EQ(source.detect.smoothness.edge_share, 0.3f);
  EXPECT_EQ(config.sources[0].detect.smoothness.theta_low_deg, 5);
  EXPECT_EQ(config.sources[1].detect.smoothness.theta_low_deg, 6);
  EXPECT_EQ(config.sources[1].detect.smoothness.theta_high_deg, 20);
  EXPECT_EQ(config.sources[0].gripper.installed_name, "franka_hand");
  EXPECT_EQ(config.workers, 3);
}

TEST_F(ConfigLayersTest, ASourceMoreAndTheBuiltInOne) {
  EXPECT_EQ(with("sources: [{name: third, channel: THIRD}]").sources.size(), 3u);
  ConfigLayers built_in;
  built_in.overrides = "sources: [{name: camera, deadline_ms: 90}]";
  const ServiceConfig config = load_layers(built_in);
  ASSERT_EQ(config.sources.size(), 1u);
  EXPECT_EQ(config.sources[0].channel, "GRASPD_CLOUD");
  EXPECT_EQ(config.sources[0].deadline_ms, 90);
}

TEST_F(ConfigLayersTest, AnAliasInTheFileIsNotChangedInAllItsPlaces) {
  layers_.file = folder_.write("alias.yaml", R"(
sources:
  - {name: a, channel: A, detect: &both {smoothness: {theta_low_deg: 6}}}
  - {name: b, channel: B, detect: *both}
)");
  const ServiceConfig config = with("sources: [{name: a, detect: {smoothness: {theta_low_deg: 7}}}]");
  EXPECT_EQ(config.sources[0].detect.smoothness.theta_low_deg, 7);
  EXPECT_EQ(config.sources[1].detect.smoothness.theta_low_deg, 6);
}

TEST_F(ConfigLayersTest, WhatCannotBeIsToldWithItsKey) {
  EXPECT_NE(error_with("workers: 0").find("workers: out of range"), std::string::npos);
  EXPECT_NE(error_with("worker: 1").find("did you mean workers?"), std::string::npos);
  EXPECT_NE(error_with("detect: {smoothness: {theta_low_deg: 30}}").find("theta"), std::string::npos);
  EXPECT_NE(error_with("sources: [{channel: X}]").find("sources[0]: no name"), std::string::npos);
  EXPECT_NE(error_with("sources: [{name: new}]").find("channel"), std::string::npos);
  EXPECT_NE(error_with("sources: 7").find("sources"), std::string::npos);
  EXPECT_NE(error_with("[1, 2]").find("wrong type"), std::string::npos);
  EXPECT_NE(error_with("{a").find("not YAML"), std::string::npos);
  EXPECT_NE(error_with("a: \xff").find("not a text file"), std::string::npos);
  EXPECT_NE(error_with(std::string(kMaxOverridesBytes + 1, '#')).find("too large"), std::string::npos);
}

TEST_F(ConfigLayersTest, AliasesThatStandForMoreThanMemoryHoldsAreRefused) {
  std::string bomb = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (int i = 1; i < 12; ++i) {
    const std::string before = "*a" + std::to_string(i - 1);
    bomb += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [";
    for (int k = 0; k < 10; ++k) bomb += (k > 0 ? ", " : "") + before;
    bomb += "]\n";
  }
  EXPECT_NE(error_with(bomb).find("too many values"), std::string::npos);
  EXPECT_THROW((void)merge_overrides("", bomb), ConfigError);
}

TEST_F(ConfigLayersTest, AFaultOfTheFileIsToldBeforeTheRest) {
  layers_.file = folder_.write("bad.yaml", "workers: many");
  EXPECT_NE(error_with("workers: 2").find("bad.yaml: workers: "), std::string::npos);
}

TEST(MergeOverrides, LaterOnesWinAndEarlierOnesStay) {
  std::string overrides = merge_overrides("", "{workers: 2, detect: {smoothness: {theta_low_deg: 5}}}");
  overrides = merge_overrides(overrides, "{workers: 3, sources: [{name: camera, deadline_ms: 5}]}");
  overrides = merge_overrides(overrides, "sources: [{name: camera, policy: all}]");
  ConfigLayers layers;
  layers.overrides = overrides;
  const ServiceConfig config = load_layers(layers);
  EXPECT_EQ(config.workers, 3);
  EXPECT_EQ(config.detect.smoothness.theta_low_deg, 5);
  EXPECT_EQ(config.sources[0].deadline_ms, 5);
  EXPECT_EQ(config.sources[0].policy, FramePolicy::kAll);
  EXPECT_EQ(merge_overrides(overrides, ""), merge_overrides(overrides, "{}"));
  EXPECT_EQ(merge_overrides("", ""), "");
}

TEST(MergeOverrides, AGripperIsReplacedAsAWhole) {
  const std::string full =
      "sources: [{name: camera, gripper: {aperture_m: 0.06, finger_width_m: 0.008, finger_thickness_m: "
      "0.015, "
      "finger_length_m: 0.05, grasp_depth_m: 0.02, min_gap_m: 0.01}}]";
  const std::string overrides =
      merge_overrides(full, "sources: [{name: camera, gripper: {aperture_m: 0.07}}]");
  ConfigLayers layers;
  layers.overrides = overrides;
  EXPECT_THROW((void)load_layers(layers), ConfigError);
  layers.overrides = merge_overrides(overrides, full);
  EXPECT_EQ(load_layers(layers).sources[0].gripper.gripper.aperture_m, 0.06f);
}

TEST(MergeOverrides, TogetherTheyMustNotBeTooLarge) {
  std::string overrides;
  const auto add_all = [&] {
    for (int i = 0; i < 100; ++i)
      overrides = merge_overrides(overrides, "key" + std::to_string(i) + ": " + std::string(1000, 'x'));
  };
  EXPECT_THROW(add_all(), ConfigError);
  EXPECT_LE(overrides.size(), kMaxOverridesBytes);
}

}  // namespace
}  // namespace graspd

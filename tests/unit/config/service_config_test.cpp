// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/config/service_config.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/temp_folder.hpp"
#include "tests/unit/config/config_error_text.hpp"

namespace graspd {
namespace {

ServiceConfig load(const std::string& text) {
  const TempFolder folder;
  return load_service_config(folder.write("graspd.yaml", text));
}

std::string error_of(const std::string& text) {
  const TempFolder folder;
  const auto file = folder.write("graspd.yaml", text);
  return config_error(file, [&] { static_cast<void>(load_service_config(file)); });
}

TEST(ServiceConfig, AnEmptyFileIsTheDefaults) {
  EXPECT_EQ(print(load("")), print(ServiceConfig{}));
}

TEST(ServiceConfig, TheDefaultsAreValid) {
  EXPECT_FALSE(ServiceConfig{}.validate());
}

constexpr const char* kFull = R"(
lcm: {url: "udpm://239.255.76.67:7668?ttl=0", status_channel: CELL_STATUS}
workers: 3
threads: 4
on_stop: drop
limits: {max_points: 400000, max_sources: 8}
detect:
  workspace: {max_range_m: 2.5}
  downsample: {leaf_size_m: 0.0035}
sources:
  - name: left
    channel: LEFT_CLOUD
    handles_channel: LEFT_HANDLES
    gripper: robotiq_2f_85
    sensor: realsense_d435
    sensor_pose: {frame_name: base, position_m: [0.1, -0.2, 1.5], rpy_rad: [3.1, 0, 0.5]}
    policy: all
    queue_length: 5
    detect:
      workspace: {min_m: [-0.5, -0.5, 0], max_range_m: 1.25}
  - name: others
    channel: "DEPTH_[0-9]+"
    gripper: {aperture_m: 0.06, finger_width_m: 0.008, finger_thickness_m: 0.015, finger_length_m: 0.05,
              grasp_depth_m: 0.02, min_gap_m: 0.01}
    sensor_pose: {frame_name: base, quaternion_wxyz: [0.5, 0.5, 0.5, 0.5]}
    input: {viewpoint_m: [0, 0.5, 1], camera: {fx_px: 528, fy_px: 529, cx_px: 320.5, cy_px: 240}}
)";

TEST(ServiceConfig, ReadsEverything) {
  const ServiceConfig config = load(kFull);
  EXPECT_EQ(config.lcm.status_channel, "CELL_STATUS");
  EXPECT_EQ(config.workers, 3);
  EXPECT_EQ(config.on_stop, StopPolicy::kDrop);
  EXPECT_EQ(config.limits.decode.max_points, 400000);
  ASSERT_EQ(config.sources.size(), 2u);
  const SourceConfig& left = config.sources[0];
  EXPECT_EQ(left.gripper.gripper.aperture_m, 0.085f);
  EXPECT_EQ(left.policy, FramePolicy::kAll);
  EXPECT_EQ(left.queue_length, 5);
  EXPECT_TRUE(left.sensor_pose.given());
  const SourceConfig& others = config.sources[1];
  EXPECT_EQ(others.gripper.gripper.name, "custom");
  EXPECT_EQ(others.gripper.gripper.aperture_m, 0.06f);
  EXPECT_EQ(others.policy, FramePolicy::kLatest);
  EXPECT_EQ(others.input.viewpoint_m, Eigen::Vector3f(0, 0.5f, 1));
  EXPECT_TRUE(others.input.camera.given());
  EXPECT_EQ(others.input.camera.fy_px, 529);
  EXPECT_EQ(others.input.camera.cx_px, 320.5);
  EXPECT_FALSE(left.input.camera.given());
}

TEST(ServiceConfig, SettingsOfTheMethodLieOverEachOther) {
  const ServiceConfig config = load(kFull);
  // Service, then sensor, then source: the later one holds.
  const WorkspaceFilterConfig& left = config.sources[0].detect.workspace;
  EXPECT_EQ(left.max_range_m, 1.25f);
  EXPECT_EQ(left.min_range_m, 0.3f);
  EXPECT_EQ(left.min_m, Eigen::Vector3f(-0.5f, -0.5f, 0));
  EXPECT_EQ(config.sources[0].detect.downsample.leaf_size_m, 0.003f);
  const WorkspaceFilterConfig& others = config.sources[1].detect.workspace;
  EXPECT_EQ(others.max_range_m, 2.5f);
  EXPECT_EQ(others.min_range_m, WorkspaceFilterConfig{}.min_range_m);
  EXPECT_EQ(config.sources[1].detect.downsample.leaf_size_m, 0.0035f);
}

TEST(ServiceConfig, TheWorkspaceIsInTheNamedFrame) {
  const ServiceConfig config = load(kFull);
  for (const SourceConfig& source : config.sources)
    EXPECT_TRUE(source.detect.workspace.T_box_cloud.isApprox(source.sensor_pose.T_target_cloud()));
  EXPECT_EQ(config.sources[0].detect.workspace.T_box_cloud.translation(), Eigen::Vector3f(0.1f, -0.2f, 1.5f));
}

TEST(ServiceConfig, PrintLoadsBackToTheSame) {
  for (const char* text : {"", kFull}) {
    const ServiceConfig config = load(text);
    const std::string printed = print(config);
    const ServiceConfig again = load(printed);
    EXPECT_EQ(print(again), printed);
    ASSERT_EQ(again.sources.size(), config.sources.size());
    for (std::size_t i = 0; i < config.sources.size(); ++i) {
      EXPECT_EQ(again.sources[i].gripper.gripper.aperture_m, config.sources[i].gripper.gripper.aperture_m);
      EXPECT_EQ(again.sources[i].detect.workspace.max_range_m,
                config.sources[i].detect.workspace.max_range_m);
      EXPECT_TRUE(again.sources[i].detect.workspace.T_box_cloud.matrix() ==
                  config.sources[i].detect.workspace.T_box_cloud.matrix());
    }
  }
}

TEST(ServiceConfig, PrintExplainsEveryKey) {
  std::string line_before;
  std::istringstream lines(print(load(kFull)));
  for (std::string line; std::getline(lines, line); line_before = line) {
    if (line.empty() || line.find_first_not_of(' ') == line.find('#')) continue;
    EXPECT_TRUE(line.find("  # ") != std::string::npos || line_before.find("# ") != std::string::npos)
        << line;
  }
}

TEST(ServiceConfig, ChannelsMatchAsAWhole) {
  EXPECT_TRUE(matches_channel("CLOUD", "CLOUD"));
  EXPECT_FALSE(matches_channel("CLOUD", "CLOUD_2"));
  EXPECT_TRUE(matches_channel("CLOUD.*", "CLOUD_2"));
  EXPECT_FALSE(matches_channel("LOUD.*", "CLOUD_2"));
  // LCM alone would anchor only the outer ends.
  EXPECT_FALSE(matches_channel("A|B", "AB"));
  EXPECT_TRUE(is_plain_channel("GRASPD_CLOUD"));
  EXPECT_TRUE(is_plain_channel("/camera/points#sensor_msgs-PointCloud2"));
  EXPECT_FALSE(is_plain_channel("CAM."));
}

struct Wrong {
  const char* yaml;
  const char* line;
};

class ServiceConfigErrors : public testing::TestWithParam<Wrong> {};

TEST_P(ServiceConfigErrors, OneExactLine) {
  EXPECT_EQ(error_of(GetParam().yaml), GetParam().line);
}

INSTANTIATE_TEST_SUITE_P(
    All, ServiceConfigErrors,
    testing::Values(
        Wrong{"worker: 2", "worker: unknown key, did you mean workers? (got worker, expected workers)"},
        Wrong{"workers: 0", "workers: out of range (got 0, expected 1 to 64)"},
        Wrong{"on_stop: wait", "on_stop: unknown value (got wait, expected finish or drop)"},
        Wrong{"detect: {workspace: {leaf: 1}}",
              "detect.workspace.leaf: unknown key (got leaf, expected one of min_m, max_m, min_range_m, "
              "max_range_m)"},
        Wrong{"detect: {workspace: {min_m: [1, 1, 1], max_m: [2, 1, 2]}}",
              "detect.workspace.max_m: the workspace is empty (got a list of 3, expected more than min_m on "
              "each axis)"},
        Wrong{"sources: {}", "sources: wrong type (got a map, expected a list)"},
        Wrong{"sources: []", "sources: nothing to work on (got a list of 0, expected at least one source)"},
        Wrong{"sources: [{name: a}]", "sources[0].channel: missing (got nothing, expected a value)"},
        Wrong{"sources: [{name: a, channel: A}, {channel: B}]",
              "sources[1].name: missing (got nothing, expected a value)"},
        Wrong{"sources: [{name: a, chanel: A}]",
              "sources[0].chanel: unknown key, did you mean channel? (got chanel, expected channel)"},
        Wrong{"sources: [{name: a, channel: A}, {name: a, channel: B}]",
              "sources[1].name: two sources have it (got a, expected a name of its own)"},
        Wrong{"sources: [{name: \"\", channel: A}]", "sources[0].name: no name (got \"\", expected one)"},
        Wrong{"sources: [{name: a, channel: \"A(\"}]",
              "sources[0].channel: not a regular expression (got \"A(\", expected one that compiles)"},
        Wrong{"sources: [{name: a, channel: A B}]",
              "sources[0].channel: not a channel (got A B, expected printable ASCII without spaces)"},
        Wrong{
            "sources: [{name: a, channel: A234567890123456789012345678901234567890123456789012345678901234}]",
            "sources[0].channel: too long for LCM (got "
            "A23456789012345678901234567890123456789012345678901234567890..., expected at most 63 "
            "characters)"},
        Wrong{"sources: [{name: a, channel: A, handles_channel: \"\"}]",
              "sources[0].handles_channel: no channel (got \"\", expected a name)"},
        Wrong{
            "sources: [{name: a, channel: A, handles_channel: GRASPD_STATUS}]",
            "sources[0].handles_channel: two types on one channel (got GRASPD_STATUS, expected another than "
            "lcm.status_channel)"},
        Wrong{"sources: [{name: a, channel: GRASPD_.*}]",
              "sources[0].channel: matches GRASPD_STATUS, which graspd itself publishes (got GRASPD_.*, "
              "expected "
              "clouds only)"},
        Wrong{"sources: [{name: a, channel: A, handles_channel: B}, {name: b, channel: \"[B-D]\"}]",
              "sources[1].channel: matches B, which graspd itself publishes (got \"[B-D]\", expected clouds "
              "only)"},
        Wrong{"{limits: {max_sources: 1}, sources: [{name: a, channel: A}, {name: b, channel: B}]}",
              "limits.max_sources: fewer than there are sources (got 1, expected at least 2)"},
        Wrong{"sources: [{name: a, channel: A, policy: newest}]",
              "sources[0].policy: unknown value (got newest, expected latest or all)"},
        Wrong{"sources: [{name: a, channel: A, input: {camera: {fx_px: 500}}}]",
              "sources[0].input.camera.fy_px: one focal length is given (expected both)"},
        Wrong{"sources: [{name: a, channel: A, input: {camera: {fx_px: 500, fy_px: 1e-6}}}]",
              "sources[0].input.camera.fy_px: too small (got 1e-6, expected at least 0.001)"},
        Wrong{"sources: [{name: a, channel: A, input: {viewpoint_m: [0, 0, 2000]}}]",
              "sources[0].input.viewpoint_m[2]: out of range (got 2000, expected -1000 to 1000)"},
        Wrong{"sources: [{name: a, channel: A, sensor_pose: {position_m: [0, 0, 1]}}]",
              "sources[0].sensor_pose.frame_name: a pose is given in no frame (expected the name of the "
              "frame it is "
              "in)"},
        Wrong{"sources: [{name: a, channel: A, sensor: sonar}]",
              "sources[0].sensor: no such file in sensors/ (got sonar, expected ensenso_n35, kinect_v1, "
              "realsense_d435 "
              "or a path)"},
        Wrong{"sources: [{name: a, channel: A, gripper: [1]}]",
              "sources[0].gripper: wrong type (got a list of 1, expected a gripper's name, path or keys)"},
        Wrong{"sources: [{name: a, channel: A, gripper: {aperture_m: 0.1}}]",
              "sources[0].gripper.finger_width_m: missing (got nothing, expected a value)"},
        Wrong{"sources: &s [{name: a, channel: A, detect: *s}]",
              "sources[0].detect: wrong type (got a list of 1, expected a map of keys and values)"}));

TEST(ServiceConfig, ErrorsInOtherFilesNameThose) {
  const TempFolder folder;
  const auto sensor =
      folder.write("sensors/mine.yaml", "detect: {workspace: {min_range_m: 3, max_range_m: 2}}");
  const auto file = folder.write("graspd.yaml", "sources: [{name: a, channel: A, sensor: mine}]");
  EXPECT_EQ(config_error(sensor, [&] { static_cast<void>(load_service_config(file)); }),
            "detect.workspace.max_range_m: the range is empty (got 2, expected more than min_range_m)");
  const auto gripper = folder.write("g.yaml", "aperture: 1");
  folder.write("graspd.yaml", "sources: [{name: a, channel: A, gripper: g.yaml}]");
  EXPECT_EQ(config_error(gripper, [&] { static_cast<void>(load_service_config(file)); }),
            "aperture: unknown key, did you mean aperture_m? (got aperture, expected aperture_m)");
}

TEST(DetectConfig, IsTheServicesThenTheSensors) {
  const TempFolder folder;
  const auto file = folder.write("graspd.yaml", "detect: {workspace: {max_range_m: 2.5, min_range_m: 0.2}}");
  EXPECT_EQ(load_detect_config(file).workspace.max_range_m, 2.5f);
  EXPECT_EQ(load_detect_config("").workspace.max_range_m, DetectConfig{}.workspace.max_range_m);
  EXPECT_EQ(load_detect_config(file, "realsense_d435").workspace.max_range_m, 1.5f);
  EXPECT_EQ(load_detect_config("", "realsense_d435").workspace.max_range_m, 1.5f);
}

TEST(ServiceConfig, TheControlChannelIsNobodyElses) {
  EXPECT_EQ(load("lcm: {control_channel: GRASPD_CONTROL}").lcm.control_channel, "GRASPD_CONTROL");
  EXPECT_EQ(load("").lcm.control_channel, "") << "off unless it is asked for";
  EXPECT_NE(error_of("lcm: {control_channel: GRASPD_STATUS}").find("lcm.control_channel: two types"),
            std::string::npos);
  EXPECT_NE(error_of("lcm: {control_channel: \"A B\"}").find("lcm.control_channel: not a channel"),
            std::string::npos);
  EXPECT_NE(error_of("lcm: {control_channel: GRASPD_HANDLES}").find("handles_channel: two types"),
            std::string::npos);
  EXPECT_NE(error_of("{lcm: {control_channel: CAM_C}, sources: [{name: a, channel: CAM_.*}]}")
                .find("sources[0].channel"),
            std::string::npos);
}

TEST(ServiceConfig, SegmentsAndRequestsHaveChannelsOfTheirOwn) {
  const ServiceConfig config = load(
      "{lcm: {request_channel: ASK}, sources: [{name: a, channel: A, segments_channel: S, publish_segments: "
      "always}]}");
  EXPECT_EQ(config.lcm.request_channel, "ASK");
  EXPECT_EQ(config.sources[0].segments_channel, "S");
  EXPECT_EQ(config.sources[0].publish_segments, PublishSegments::kAlways);
  EXPECT_EQ(load("").sources[0].publish_segments, PublishSegments::kOnRequest);
  EXPECT_EQ(load("lcm: {request_channel: \"\"}").lcm.request_channel, "") << "nobody can ask";
  const auto refuses = [](const std::string& text, const std::string& start) {
    const std::string error = error_of(text);
    EXPECT_EQ(error.find(start), 0u) << error;
  };
  refuses("lcm: {request_channel: GRASPD_STATUS}", "lcm.request_channel: two types");
  refuses("lcm: {request_channel: C, control_channel: C}", "lcm.request_channel: two types");
  refuses("lcm: {request_channel: GRASPD_HANDLES}", "sources[0].handles_channel: two types");
  refuses("lcm: {request_channel: GRASPD_CLOUD}", "sources[0].channel: matches lcm.request_channel");
  refuses("sources: [{name: a, channel: A, segments_channel: GRASPD_HANDLES}]",
          "sources[0].segments_channel: two types");
  refuses("sources: [{name: a, channel: A, segments_channel: \"\"}]",
          "sources[0].segments_channel: no channel");
  refuses("sources: [{name: a, channel: \".*SEGMENTS\"}]", "sources[0].channel: matches GRASPD_SEGMENTS");
  refuses("sources: [{name: a, channel: A, publish_segments: yes}]", "sources[0].publish_segments: unknown");
}

TEST(ServiceConfig, DegradationIsCheckedAgainstTheSourcesOwnVoxels) {
  const std::string error = error_of(
      "sources: [{name: a, channel: A, detect: {downsample: {leaf_size_m: 0.005}}, degrade: {voxel_m: "
      "0.004}}]");
  EXPECT_NE(error.find("sources[0].degrade.voxel_m: not coarser"), std::string::npos) << error;
}

}  // namespace
}  // namespace graspd

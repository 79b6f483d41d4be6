// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/detect/file_detection.hpp"

#include <gtest/gtest.h>

#include "client/common/handle_csv.hpp"
#include "client/common/handle_text.hpp"
#include "client/simulate/simulation.hpp"
#include "service/pipeline/detect_handles.hpp"
#include "service/transport/cloud_decoder.hpp"
#include "service/transport/cloud_encoder.hpp"
#include "service/transport/handle_list_codec.hpp"

namespace graspd {
namespace {

PointCloud cloud() {
  SimulationConfig config;
  config.camera = {320, 240, 262.5, 262.5, 159.5, 119.5};
  config.sensor = *sensor_model("kinect");
  return to_cloud(Simulation(config).frame(0)).cloud;
}

/// As the daemon goes: over the wire, through the pipeline, over the wire.
handle_list_t over_the_wire(const PointCloud& sent, const SourceConfig& source) {
  const auto message = encode(make_point_cloud({5, 7, "file"}, sent));
  const auto decoded = decode_cloud(message, DecodeLimits{});
  const PointCloud& received = std::get<Frame>(decoded).cloud;
  HandleListHeader header;
  header.seq = 7;
  header.frame_name = "file";
  const Detection detection = detect_handles(received, source.gripper.gripper, source.detect);
  header.status = wire_status(detection.status);
  const auto answer = encode(
      make_handle_list(header, source.gripper.gripper, detection, source.sensor_pose.T_target_cloud()));
  return *decode_handle_list(answer);
}

TEST(FileDetection, GivesTheSameBitsAsTheWire) {
  SourceConfig source;
  const handle_list_t from_file = detect_in_cloud(cloud(), "file", 7, source).list;
  const handle_list_t from_wire = over_the_wire(cloud(), source);
  EXPECT_FALSE(from_file.handles.empty());
  EXPECT_EQ(handle_csv_rows(from_file), handle_csv_rows(from_wire));
  EXPECT_EQ(from_file.num_candidates, from_wire.num_candidates);
}

TEST(FileDetection, SensorsPoseMovesTheHandles) {
  SourceConfig source;
  source.sensor_pose.frame_name = "base";
  source.sensor_pose.position_m = {0.3f, 0.1f, 1.2f};
  source.sensor_pose.rpy_rad = {-2.2, 0.1, 0.7};
  EXPECT_EQ(handle_csv_rows(detect_in_cloud(cloud(), "file", 7, source).list),
            handle_csv_rows(over_the_wire(cloud(), source)));
}

TEST(FileDetection, AnEmptyCloudHasItsStatus) {
  const handle_list_t list = detect_in_cloud(PointCloud{}, "nothing", 0, SourceConfig{}).list;
  EXPECT_EQ(status_name(list.status), "EMPTY_CLOUD");
  EXPECT_EQ(handle_csv_rows(list), "");
  EXPECT_TRUE(detection_stats(list).starts_with("nothing: EMPTY_CLOUD, 0 handles, 0 of 0 points"));
}

TEST(FileDetection, StatsNameStagesAndReasons) {
  const std::string stats = detection_stats(detect_in_cloud(cloud(), "file", 0, SourceConfig{}).list);
  EXPECT_NE(stats.find("candidates failed: "), std::string::npos);
  EXPECT_NE(stats.find("normals "), std::string::npos) << stats;
}

}  // namespace
}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The settings of one source of clouds.
#pragma once
#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "service/pipeline/config_fields.hpp"
#include "service/pipeline/detect_config.hpp"
#include "service/pipeline/gripper.hpp"
#include "service/transport/cloud_input.hpp"

namespace graspd {

/// Which frames are worked on when they come faster than they can be.
enum class FramePolicy { kLatest, kAll };
[[nodiscard]] constexpr std::array<std::string_view, 2> choices(FramePolicy) {
  return {"latest", "all"};
}

/// When frames are followed by what was seen in them.
enum class PublishSegments { kNever, kOnRequest, kAlways };
[[nodiscard]] constexpr std::array<std::string_view, 3> choices(PublishSegments) {
  return {"never", "on_request", "always"};
}

/// Where the sensor is (extrinsics). Without a frame name handles stay in the cloud's frame.
struct SensorPose {
  std::string frame_name;
  Eigen::Vector3f position_m = Eigen::Vector3f::Zero();
  std::vector<double> quaternion_wxyz;  ///< empty or 4
  std::vector<double> rpy_rad;          ///< empty or 3: R = Rz(yaw) Ry(pitch) Rx(roll)

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& v) {
    v("frame_name", self.frame_name, Range{},
      "frame that handles and workspace are in, for example the robot's base; empty: the cloud's own");
    v("position_m", self.position_m, Range{-1000, 1000}, "the cloud's origin in that frame [m]");
    v("quaternion_wxyz", self.quaternion_wxyz, Range{-1, 1},
      "rotation from the cloud's frame to that frame, unit length; empty: rpy_rad, or none");
    v("rpy_rad", self.rpy_rad, Range{-6.2832, 6.2832},
      "the same as roll, pitch, yaw [rad]: Rz(yaw) Ry(pitch) Rx(roll)");
  }

  [[nodiscard]] bool given() const { return !frame_name.empty(); }
  /// Takes points of the cloud to the named frame.
  [[nodiscard]] Eigen::Isometry3f T_target_cloud() const;
  /// One form of the rotation at most, of unit length; nothing without a frame name.
  [[nodiscard]] std::optional<ConfigProblem> validate() const;
};

/// What is given up when frames cannot be worked on as fast as they come: smaller voxels.
struct DegradeConfig {
  double voxel_m = 0;
  double above_ms = 100;
  double above_drop_share = 0.5;
  double below_ms = 50;
  double hold_s = 10;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& v) {
    v("voxel_m", self.voxel_m, Range{0, 0.1},
      "edge of a voxel while degraded, more than leaf_size_m; neighbourhoods grow as much [m]; 0: never");
    v("above_ms", self.above_ms, Range{1, 60000},
      "when the mean latency, arrival to answer, of the last 8 frames is above this [ms]");
    v("above_drop_share", self.above_drop_share, Range{0, 1},
      "or more than this share of the last 16 frames was dropped for newer ones; 1: whatever is dropped");
    v("below_ms", self.below_ms, Range{0, 60000},
      "until the mean latency is below this again and half as many are dropped [ms]");
    v("hold_s", self.hold_s, Range{0, 3600}, "and for so long at least; longer where that was too early [s]");
  }

  /// below_ms is less than above_ms.
  [[nodiscard]] std::optional<ConfigProblem> validate() const;
};

/// A gripper by the name of an installed file, or in full. In YAML: a name, a path, or a map of a gripper
/// file's keys.
struct GripperSetting {
  std::string installed_name;  ///< empty: not one of the installed files, or changed
  Gripper gripper;
};

struct SourceConfig {
  std::string name = "camera";
  std::string channel = "GRASPD_CLOUD";
  std::string handles_channel = "GRASPD_HANDLES";
  std::string segments_channel = "GRASPD_SEGMENTS";
  PublishSegments publish_segments = PublishSegments::kOnRequest;
  FramePolicy policy = FramePolicy::kLatest;
  int queue_length = 30;
  int deadline_ms = 0;
  DegradeConfig degrade;
  GripperSetting gripper{"paper_80mm", Gripper{}};
  std::string sensor;
  CloudInput input;
  SensorPose sensor_pose;
  DetectConfig
      detect;  ///< complete: the service's, then the sensor's, then the source's own; T_box_cloud is set

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& v) {
    v("name", self.name, Range{}, "name in status and log; required");
    v("channel", self.channel, Range{},
      "channel of the clouds or depth images, or a regular expression for the whole name; required");
    v("handles_channel", self.handles_channel, Range{}, "channel of the answers, handle_list_t");
    v("segments_channel", self.segments_channel, Range{}, "channel of segmentation_t");
    v("publish_segments", self.publish_segments, Range{},
      "each frame's points and segments go out too: never, while somebody asks for them on "
      "lcm.request_channel, or always");
    v("policy", self.policy, Range{},
      "latest: a newer frame replaces one that waits; all: frames wait in turn");
    v("queue_length", self.queue_length, Range{1, 1000}, "frames that wait at most, with policy all");
    v("deadline_ms", self.deadline_ms, Range{0, 600000},
      "a frame not answered so long after its arrival is given up and answered OVERLOADED [ms]; 0: none");
    v("degrade", self.degrade, "coarser voxels while frames cannot keep up");
    v("gripper", self.gripper, Range{}, "name of a file in grippers/, or its path, or its keys");
    v("sensor", self.sensor, Range{},
      "name of a file in sensors/, or its path, with settings of the method for that sensor; empty: none");
    v("input", self.input, "what messages of some types do not say themselves");
    v("sensor_pose", self.sensor_pose, "where the sensor is (extrinsics)");
    v("detect", self.detect, "what differs from detect: above, for this source");
  }

  /// What holds while degraded: coarser voxels, and neighbourhoods of as many of them.
  [[nodiscard]] DetectConfig degraded_detect() const;
  /// Degraded voxels are coarser ones.
  [[nodiscard]] std::optional<ConfigProblem> validate() const;
};

}  // namespace graspd

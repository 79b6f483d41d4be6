// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/handle_list_codec.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <stdexcept>

#include "tests/unit/transport/allocations.hpp"
#include "tests/unit/transport/message_samples.hpp"

namespace graspd {
namespace {

Handle some_handle(int segment) {
  Handle handle;
  handle.position = {0.1f, 0.2f, 0.7f};
  handle.rotation = Eigen::AngleAxisf(1.1f, Eigen::Vector3f(1, 2, 3).normalized()).toRotationMatrix();
  handle.width_m = 0.043f;
  handle.gap_m = {0.013f, 0.08f};
  handle.observed_free = {0.5f, 1.0f};
  handle.score = 0.75f;
  handle.segment = segment;
  handle.num_points = 321;
  return handle;
}

Eigen::Map<const Eigen::Vector3d> vector(const double (&values)[3]) {
  return Eigen::Map<const Eigen::Vector3d>(values);
}

TEST(HandleListCodec, EqualsTheGeneratedDecoderOnValidMessages) {
  Random random(44);
  for (int i = 0; i < 500; ++i) {
    const Bytes message = encode(random_handle_list(random));
    ASSERT_EQ(message, raw_bytes(generated_decode<handle_list_t>(message)));
    const auto list = decode_handle_list(message);
    ASSERT_TRUE(list.has_value());
    ASSERT_EQ(encode(*list), message);
  }
}

TEST(HandleListCodec, RefusesTruncatedLongerAndForeignMessages) {
  Random random(45);
  Bytes message;
  while (message.size() < 700) message = encode(random_handle_list(random));
  for_each_truncation(message, [](const Bytes& part) { EXPECT_FALSE(decode_handle_list(part).has_value()); });
  message.push_back({});
  EXPECT_FALSE(decode_handle_list(message).has_value());
  EXPECT_FALSE(decode_handle_list(raw_bytes(small_point_cloud())).has_value());
  EXPECT_FALSE(decode_handle_list(raw_bytes(random_status(random))).has_value());
}

TEST(HandleListCodec, SurvivesEveryCorruption) {
  Random random(46);
  handle_list_t list = random_handle_list(random);
  while (list.num_handles != 1 || list.num_stages == 0) list = random_handle_list(random);
  const Bytes message = encode(list);
  forget_allocations();
  for_each_corruption(message, [](const Bytes& corrupt) { (void)decode_handle_list(corrupt); });
  EXPECT_LT(largest_allocation(), 100'000u);
}

TEST(HandleListCodec, CountsThatLieAreRefusedOrThrow) {
  handle_list_t list = random_handle_list(*std::make_unique<Random>(47));
  list.handles.clear();
  list.num_handles = 0;
  Bytes message = encode(list);
  for (const std::int32_t count : {std::numeric_limits<std::int32_t>::min(), -1, 1, 100'000, 0x7fffffff}) {
    put(message, message.size() - 4, count, 4);
    forget_allocations();
    EXPECT_FALSE(decode_handle_list(message).has_value());
    EXPECT_LT(largest_allocation(), 100'000u);
    list.num_handles = count;
    EXPECT_THROW((void)encode(list), std::invalid_argument);
  }
}

/// Two handles and some failures.
Detection some_detection() {
  Detection detection;
  detection.status = DetectionStatus::kOk;
  detection.points_in = 5;
  detection.points_used = 4;
  detection.segments.resize(3);
  detection.segments[0].num_handles = detection.segments[2].num_handles = 1;
  detection.segments[1].failures[static_cast<std::size_t>(Failure::kPalm)] = 2;
  detection.num_candidates = 2;
  detection.candidate_failures[static_cast<std::size_t>(Failure::kPalm)] = 7;
  detection.candidate_failures[static_cast<std::size_t>(Failure::kTooWide)] = 8;
  detection.handles = {some_handle(9), some_handle(4)};
  return detection;
}

HandleListHeader some_header() {
  return {11,
          12,
          "CLOUD",
          "camera",
          handle_list_t::OK,
          "text",
          6,
          0.004,
          true,
          0.25,
          {{"normals", 1.5}, {"growing", 2.5}}};
}

Gripper some_gripper() {
  Gripper gripper;
  gripper.name = "test";
  gripper.min_gap_m = 0.017f;
  return gripper;
}

Bytes bytes_of(const HandleListMessage& message) {
  return {message.bytes.begin(), message.bytes.end()};
}

TEST(HandleListCodec, WhatIsWrittenStraightEqualsTheList) {
  const Detection detection = some_detection();
  const Eigen::Isometry3f T =
      Eigen::Translation3f(1, 2, 3) * Eigen::AngleAxisf(0.7f, Eigen::Vector3f(3, 1, 2).normalized());
  HandleListMessage message;
  for (const Detection& d : {detection, Detection{}, detection}) {  // the buffer is kept
    encode(some_header(), some_gripper(), d, T, message);
    EXPECT_EQ(bytes_of(message), encode(make_handle_list(some_header(), some_gripper(), d, T)));
  }
  HandleListHeader late = some_header();
  late.latency_s = 0.75;
  message.set_latency(0.75);
  EXPECT_EQ(bytes_of(message), encode(make_handle_list(late, some_gripper(), detection, T)));
}

TEST(HandleListCodec, TextEndsAtItsNulOnEitherWay) {
  HandleListHeader header = some_header();
  header.frame_name = std::string_view("ab\0cd", 5);
  HandleListMessage message;
  encode(header, some_gripper(), {}, Eigen::Isometry3f::Identity(), message);
  EXPECT_EQ(bytes_of(message),
            encode(make_handle_list(header, some_gripper(), {}, Eigen::Isometry3f::Identity())));
  EXPECT_EQ(decode_handle_list(message.bytes)->frame_name, "ab");
}

TEST(HandleListCodec, ListSaysWhatTheDetectionFound) {
  const Detection detection = some_detection();
  const HandleListHeader header = some_header();
  const Gripper gripper = some_gripper();
  const auto list =
      decode_handle_list(encode(make_handle_list(header, gripper, detection, Eigen::Isometry3f::Identity())));
  ASSERT_TRUE(list.has_value());
  EXPECT_EQ(list->utime, 11);
  EXPECT_EQ(list->seq, 12);
  EXPECT_EQ(list->source_channel, "CLOUD");
  EXPECT_EQ(list->frame_name, "camera");
  EXPECT_EQ(list->status, +handle_list_t::OK);
  EXPECT_EQ(list->status_text, "text");
  EXPECT_EQ(list->config_revision, 6);
  EXPECT_EQ(list->voxel_size, 0.004);
  EXPECT_EQ(list->degraded, 1);
  EXPECT_EQ(list->gripper.name, "test");
  EXPECT_EQ(list->gripper.min_gap, double{0.017f});
  EXPECT_EQ(list->gripper.aperture, double{gripper.aperture_m});
  EXPECT_EQ(list->points_in, 5);
  EXPECT_EQ(list->points_used, 4);
  EXPECT_EQ(list->num_segments, 3);
  EXPECT_EQ(list->num_candidates, 2);
  ASSERT_EQ(list->num_candidate_failures, 2);
  EXPECT_EQ(list->candidate_failures[0].reason, name(Failure::kTooWide));  // in the order of the checks
  EXPECT_EQ(list->candidate_failures[0].count, 8);
  EXPECT_EQ(list->candidate_failures[1].count, 7);
  ASSERT_EQ(list->num_segment_failures, 1);
  EXPECT_EQ(list->segment_failures[0].reason, name(Failure::kPalm));
  EXPECT_EQ(list->segment_failures[0].count, 1);
  ASSERT_EQ(list->num_stages, 2);
  EXPECT_EQ(list->stages[1].stage, "growing");
  EXPECT_EQ(list->stages[1].milliseconds, 2.5);
  EXPECT_EQ(list->latency, 0.25);
  ASSERT_EQ(list->num_handles, 2);
  EXPECT_EQ(list->handles[0].id, 0);
  EXPECT_EQ(list->handles[0].segment_id, 9);
  EXPECT_EQ(list->handles[1].id, 1);
  EXPECT_EQ(list->handles[1].segment_id, 4);
}

TEST(HandleListCodec, HandleKeepsItsBitsInItsOwnFrame) {
  Detection detection;
  const Handle handle = some_handle(1);
  detection.handles = {handle};
  const handle_t wire = make_handle_list({}, {}, detection, Eigen::Isometry3f::Identity()).handles[0];
  EXPECT_EQ(vector(wire.position), handle.position.cast<double>());
  EXPECT_EQ(vector(wire.major_axis), handle.rotation.col(0).cast<double>());
  EXPECT_EQ(vector(wire.closing_axis), handle.rotation.col(1).cast<double>());
  EXPECT_EQ(vector(wire.approach), handle.rotation.col(2).cast<double>());
  const Eigen::Quaternionf q = quaternion(handle.rotation);
  EXPECT_EQ(wire.orientation[0], double{q.w()});
  EXPECT_EQ(wire.orientation[1], double{q.x()});
  EXPECT_EQ(wire.orientation[2], double{q.y()});
  EXPECT_EQ(wire.orientation[3], double{q.z()});
  EXPECT_EQ(vector(wire.rpy), roll_pitch_yaw(handle.rotation).cast<double>());
  EXPECT_EQ(wire.width, double{handle.width_m});
  EXPECT_EQ(wire.gap[0], double{handle.gap_m[0]});
  EXPECT_EQ(wire.gap[1], double{handle.gap_m[1]});
  EXPECT_EQ(wire.observed_free[0], 0.5);
  EXPECT_EQ(wire.observed_free[1], 1.0);
  EXPECT_EQ(wire.num_points, 321);
  EXPECT_EQ(wire.score, 0.75);
}

TEST(HandleListCodec, HandlesMoveToTheTargetFrame) {
  Eigen::Isometry3f T_robot_camera = Eigen::Isometry3f::Identity();
  T_robot_camera.translate(Eigen::Vector3f(1, 2, 3))
      .rotate(Eigen::AngleAxisf(0.7f, Eigen::Vector3f::UnitX()));
  Detection detection;
  const Handle handle = some_handle(1);
  detection.handles = {handle};
  const handle_t wire = make_handle_list({}, {}, detection, T_robot_camera).handles[0];
  EXPECT_TRUE(vector(wire.position).isApprox((T_robot_camera * handle.position).cast<double>(), 1e-5));
  EXPECT_TRUE(vector(wire.approach)
                  .isApprox((T_robot_camera.linear() * handle.rotation.col(2)).cast<double>(), 1e-5));
  const double* o = wire.orientation;
  const Eigen::Matrix3d R = Eigen::Quaterniond(o[0], o[1], o[2], o[3]).toRotationMatrix();
  EXPECT_TRUE(R.col(0).isApprox(vector(wire.major_axis), 1e-5));
  EXPECT_TRUE(R.col(1).isApprox(vector(wire.closing_axis), 1e-5));
  EXPECT_TRUE(R.col(2).isApprox(vector(wire.approach), 1e-5));
  const Eigen::Matrix3d from_rpy = (Eigen::AngleAxisd(wire.rpy[2], Eigen::Vector3d::UnitZ()) *
                                    Eigen::AngleAxisd(wire.rpy[1], Eigen::Vector3d::UnitY()) *
                                    Eigen::AngleAxisd(wire.rpy[0], Eigen::Vector3d::UnitX()))
                                       .toRotationMatrix();
  EXPECT_TRUE(from_rpy.isApprox(R, 1e-5));
}

TEST(HandleListCodec, EveryDetectionStatusHasItsOwnOnTheWire) {
  using enum DetectionStatus;
  std::set<std::int8_t> seen;
  for (const auto status : {kOk, kEmptyCloud, kNoFinitePoints, kNothingInWorkspace, kNoHandles}) {
    EXPECT_TRUE(seen.insert(wire_status(status)).second);
  }
  EXPECT_EQ(wire_status(kEmptyCloud), +handle_list_t::EMPTY_CLOUD);
  EXPECT_FALSE(seen.contains(+handle_list_t::FAILED));
}

}  // namespace
}  // namespace graspd

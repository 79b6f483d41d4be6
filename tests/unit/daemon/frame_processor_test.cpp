// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/daemon/frame_processor.hpp"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <atomic>
#include <cstring>
#include <limits>
#include <set>
#include <string>

#include "service/transport/cloud_decoder.hpp"
#include "tests/unit/daemon/messages.hpp"
#include "tests/unit/runtime/manual_clock.hpp"

namespace graspd {
namespace {

/// An answer with its list as a listener reads it.
struct ReadAnswer {
  explicit ReadAnswer(const Answer& answer)
      : outcome(answer.outcome),
        refusal(answer.refusal),
        list(decode_handle_list(answer.list.bytes).value_or(handle_list_t{})) {
    EXPECT_EQ(list.status_text, std::string_view(answer.status_text));
    EXPECT_EQ(list.degraded != 0, answer.degraded);
  }

  Outcome outcome;
  std::optional<RefusalReason> refusal;
  handle_list_t list;
};

class FrameProcessorTest : public testing::Test {
 protected:
  [[nodiscard]] FrameMessage message(const Bytes& bytes) const {
    return {peek_header(bytes, limits_), {bytes.begin(), bytes.end()}, clock_.now()};
  }
  [[nodiscard]] ReadAnswer process(const Bytes& bytes) const {
    return ReadAnswer(FrameProcessor(source_, "CLOUD_7", limits_, clock_, 4)
                          .process(message(bytes), Effort::kFull, running_));
  }

#ifdef __SANITIZE_THREAD__
  // As in daemon_test.cpp.
  const tbb::global_control one_thread_{tbb::global_control::max_allowed_parallelism, 1};
#endif
  SourceConfig source_;
  DecodeLimits limits_;
  ManualClock clock_;
  const std::atomic<bool> running_{false};  // not cancelled
};

void expect_consistent(const handle_list_t& list) {
  EXPECT_EQ(list.source_channel, "CLOUD_7");
  EXPECT_EQ(list.gripper.name, "paper_80mm");
  EXPECT_EQ(list.num_handles, static_cast<int>(list.handles.size()));
  EXPECT_EQ(list.num_stages, static_cast<int>(list.stages.size()));
  EXPECT_FALSE(list.status_text.empty());
  EXPECT_EQ(list.status_text.find('\n'), std::string::npos);
}

TEST_F(FrameProcessorTest, ABoxOnATable) {
  const ReadAnswer answer = process(cloud_message(5, box_on_table()));
  EXPECT_EQ(answer.outcome, Outcome::kProcessed);
  expect_consistent(answer.list);
  EXPECT_EQ(answer.list.status, +handle_list_t::OK) << answer.list.status_text;
  EXPECT_EQ(answer.list.status_text, std::to_string(answer.list.num_handles) + " handles");
  EXPECT_GT(answer.list.num_handles, 0);
  EXPECT_EQ(answer.list.seq, 5);
  EXPECT_EQ(answer.list.utime, 1'000'005);
  EXPECT_EQ(answer.list.frame_name, "camera");
  EXPECT_EQ(answer.list.points_in, 201 * 201);
  ASSERT_GT(answer.list.num_stages, 2);
  EXPECT_EQ(answer.list.stages[0].stage, "decode");
  std::set<std::string> names;
  for (const stage_time_t& stage : answer.list.stages)
    EXPECT_TRUE(names.insert(stage.stage).second) << stage.stage;
}

TEST_F(FrameProcessorTest, HandlesComeOutInTheNamedFrame) {
  const Bytes bytes = cloud_message(1, box_on_table());
  const ReadAnswer plain = process(bytes);
  source_.sensor_pose.frame_name = "base";
  source_.sensor_pose.position_m = {1, 2, 3};
  source_.detect.workspace.T_box_cloud = source_.sensor_pose.T_target_cloud();
  const ReadAnswer moved = process(bytes);
  EXPECT_EQ(moved.list.frame_name, "base");
  ASSERT_EQ(moved.list.num_handles, plain.list.num_handles);
  for (std::size_t i = 0; i < plain.list.handles.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(moved.list.handles[i].position[axis], plain.list.handles[i].position[axis] + axis + 1,
                  1e-5);
  }
}

TEST_F(FrameProcessorTest, CloudsWithNothingInThem) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const auto status = [&](const Bytes& bytes) {
    const ReadAnswer answer = process(bytes);
    EXPECT_EQ(answer.outcome, Outcome::kProcessed);
    expect_consistent(answer.list);
    EXPECT_EQ(answer.list.num_handles, 0);
    EXPECT_EQ(answer.list.seq, 3);
    return answer.list.status;
  };
  EXPECT_EQ(status(cloud_message(3, PointCloud{})), +handle_list_t::EMPTY_CLOUD);
  EXPECT_EQ(status(cloud_message(3, uniform_cloud(100, kNan))), +handle_list_t::NO_FINITE_POINTS);
  EXPECT_EQ(status(cloud_message(3, uniform_cloud(100, 1e6f))), +handle_list_t::NOTHING_IN_WORKSPACE);
  EXPECT_EQ(status(cloud_message(3, uniform_cloud(100, 0.5f))), +handle_list_t::NO_HANDLES);
  EXPECT_EQ(status(depth_message(3, 0)), +handle_list_t::NO_FINITE_POINTS);
  EXPECT_EQ(status(depth_message(3, 1)), +handle_list_t::NO_HANDLES);
}

TEST_F(FrameProcessorTest, MessagesThatAreNone) {
  const ReadAnswer none = process({});
  EXPECT_EQ(none.outcome, Outcome::kRefused);
  EXPECT_EQ(none.refusal, RefusalReason::kTruncated);
  EXPECT_EQ(none.list.status, +handle_list_t::REFUSED);
  EXPECT_EQ(none.list.seq, -1);
  expect_consistent(none.list);

  Bytes truncated = cloud_message(9, box_on_table());
  truncated.pop_back();
  const ReadAnswer answer = process(truncated);
  EXPECT_EQ(answer.outcome, Outcome::kRefused);
  EXPECT_EQ(answer.list.seq, 9);
  EXPECT_EQ(answer.list.frame_name, "camera");
  EXPECT_EQ(answer.list.status_text.find(std::string(name(*answer.refusal)) + ": "), 0u);
}

TEST_F(FrameProcessorTest, TooManyPointsAreRefused) {
  limits_.max_points = 100;
  EXPECT_EQ(process(cloud_message(1, uniform_cloud(100, 0.5f))).outcome, Outcome::kProcessed);
  const ReadAnswer answer = process(cloud_message(1, uniform_cloud(101, 0.5f)));
  EXPECT_EQ(answer.outcome, Outcome::kRefused);
  EXPECT_EQ(answer.refusal, RefusalReason::kTooLarge);
}

TEST_F(FrameProcessorTest, ACancelledFrameIsDropped) {
  const std::atomic<bool> cancelled{true};
  const FrameProcessor processor(source_, "CLOUD_7", limits_, clock_, 4);
  const ReadAnswer answer(
      processor.process(message(cloud_message(4, box_on_table())), Effort::kFull, cancelled));
  EXPECT_EQ(answer.outcome, Outcome::kDropped);
  EXPECT_EQ(answer.list.status, +handle_list_t::OVERLOADED);
  EXPECT_EQ(answer.list.seq, 4);
  EXPECT_EQ(answer.list.num_handles, 0);
  expect_consistent(answer.list);
}

TEST_F(FrameProcessorTest, LessEffortIsSeenInTheAnswer) {
  source_.degrade.voxel_m = 0.006;
  const FrameProcessor processor(source_, "CLOUD_7", limits_, clock_, 4);
  const FrameMessage frame = message(cloud_message(5, box_on_table()));
  const ReadAnswer full(processor.process(frame, Effort::kFull, running_));
  const ReadAnswer degraded(processor.process(frame, Effort::kDegraded, running_));
  expect_consistent(degraded.list);
  EXPECT_EQ(full.list.degraded, 0);
  EXPECT_EQ(degraded.list.degraded, 1);
  EXPECT_FLOAT_EQ(static_cast<float>(full.list.voxel_size), source_.detect.downsample.leaf_size_m);
  EXPECT_FLOAT_EQ(static_cast<float>(degraded.list.voxel_size), 0.006f);
  EXPECT_LT(degraded.list.points_used, full.list.points_used);
  EXPECT_EQ(degraded.list.status, +handle_list_t::OK) << degraded.list.status_text;
  EXPECT_EQ(degraded.list.config_revision, 4);
}

TEST_F(FrameProcessorTest, LessEffortIsTheSameWhereNoneIsConfigured) {
  const FrameProcessor processor(source_, "CLOUD_7", limits_, clock_, 4);
  const ReadAnswer answer(
      processor.process(message(cloud_message(5, box_on_table())), Effort::kDegraded, running_));
  EXPECT_EQ(answer.list.degraded, 0);
}

TEST_F(FrameProcessorTest, DeadlinesCountFromTheArrival) {
  FrameMessage frame = message(cloud_message(5, PointCloud{}));
  frame.arrival = Clock::TimePoint(std::chrono::seconds(7));
  EXPECT_FALSE(FrameProcessor(source_, "CLOUD_7", limits_, clock_, 1).deadline(frame));
  source_.deadline_ms = 250;
  EXPECT_EQ(FrameProcessor(source_, "CLOUD_7", limits_, clock_, 1).deadline(frame),
            frame.arrival + std::chrono::milliseconds(250));
}

/// Gives the time until it is asked once too often: an exception in the middle of a frame.
class FailingClock final : public Clock {
 public:
  [[nodiscard]] TimePoint now() const override {
    if (++calls_ > 2) throw std::runtime_error("out of time");
    return {};
  }
  [[nodiscard]] std::int64_t wall_utime() const override { return 0; }

 private:
  mutable int calls_ = 0;
};

TEST_F(FrameProcessorTest, AnExceptionBecomesAFailedAnswer) {
  const FailingClock failing;
  const FrameProcessor processor(source_, "CLOUD_7", limits_, failing, 4);
  const ReadAnswer answer(
      processor.process(message(cloud_message(6, box_on_table())), Effort::kFull, running_));
  EXPECT_EQ(answer.outcome, Outcome::kFailed);
  EXPECT_EQ(answer.list.status, +handle_list_t::FAILED);
  EXPECT_EQ(answer.list.status_text, "out of time");
  EXPECT_EQ(answer.list.seq, 6);
  expect_consistent(answer.list);
}

}  // namespace
}  // namespace graspd

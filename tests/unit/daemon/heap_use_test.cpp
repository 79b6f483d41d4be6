// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// From bytes to bytes without the heap: after some frames, all memory that a frame needs is there.
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <atomic>
#include <cstdlib>
#include <numbers>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "client/simulate/simulation.hpp"
#include "service/daemon/frame_processor.hpp"
#include "service/runtime/kept_memory.hpp"
#include "service/transport/cloud_decoder.hpp"
#include "service/transport/cloud_encoder.hpp"
#include "tests/support/heap_use.hpp"
#include "tests/unit/runtime/manual_clock.hpp"

namespace graspd {
namespace {

constexpr double kMillimetre_m = 0.001;

SimulationConfig scenes_of(SceneKind kind) {
  SimulationConfig config;
  config.scene.kind = kind;
  config.camera = scaled(config.camera, 320);
  config.elevation_rad = usual_elevation_deg(config.scene.kind) * std::numbers::pi / 180;
  config.new_scene_every = 1;
  return config;
}

/// Two tables and a shelf, each as a depth image and as a cloud; names are longer than what fits into a
/// string itself.
std::vector<std::pmr::vector<std::byte>> some_messages() {
  std::vector<std::pmr::vector<std::byte>> messages;
  std::int64_t k = 0;
  for (const SceneKind kind : {SceneKind::kMedium, SceneKind::kMedium, SceneKind::kShelf}) {
    const DepthFrame frame = Simulation(scenes_of(kind)).frame(k++);
    const FrameHeader header{k, k, "the_camera_over_the_table_optical_frame"};
    const Pinhole& p = frame.camera;
    const std::vector<std::uint16_t> units = depth_units(frame.depth_m, kMillimetre_m);
    const DepthCamera camera{p.width, p.height, p.fx, p.fy, p.cx, p.cy, kMillimetre_m};
    for (const std::vector<std::byte>& bytes : {encode(make_depth_image(header, camera, units)),
                                                encode(make_point_cloud(header, to_cloud(frame).cloud))})
      messages.emplace_back(bytes.begin(), bytes.end());
  }
  return messages;
}

class HeapUseTest : public testing::TestWithParam<int> {
 protected:
  static void SetUpTestSuite() { keep_memory(); }
  void SetUp() override {
    if (!heap_use_is_counted()) GTEST_SKIP() << "malloc is the sanitizer's here and cannot be counted";
  }

  /// All messages once; the number of handles.
  std::size_t run_frames() {
    std::size_t handles = 0;
    for (const FrameMessage& message : messages_) {
      arena_.execute([&] {
        const Answer answer = processor_.process(message, Effort::kFull, running_);
        EXPECT_EQ(answer.outcome, Outcome::kProcessed);
        handles += answer.list.bytes.size() > 1000 ? 1 : 0;
      });
    }
    return handles;
  }

  const int threads_ = GetParam();
  const tbb::global_control limit_{tbb::global_control::max_allowed_parallelism,
                                   static_cast<std::size_t>(threads_)};
  tbb::task_arena arena_{threads_};
  const std::atomic<bool> running_{false};
  ManualClock clock_;
  const FrameProcessor processor_{SourceConfig{}, "THE_CAMERA_OVER_THE_TABLE", DecodeLimits{}, clock_, 1};
  std::vector<FrameMessage> messages_ = [this] {
    std::vector<FrameMessage> list;
    for (auto& bytes : some_messages()) list.push_back({peek_header(bytes, {}), bytes, clock_.now()});
    return list;
  }();
};

/// What threads need at the same time depends on who comes first, so that it takes some rounds until each has
/// been the one that needs most.
TEST_P(HeapUseTest, FramesNeedNoneOnceOthersHaveGoneBefore) {
  constexpr int kMostRounds = 100, kQuietRounds = 4;
  const int warm_rounds = threads_ == 1 ? 2 : kMostRounds;
  std::string stacks;
  int quiet = 0;
  for (int round = 0; round < kMostRounds && quiet < kQuietRounds; ++round) {
    const HeapUse use;
    EXPECT_GT(run_frames(), 3u);
    const std::size_t count = use.count();
    quiet = count == 0 ? quiet + 1 : 0;
    if (count > 0)
      stacks = std::to_string(count) + " times in round " + std::to_string(round) + '\n' + use.stacks();
    if (round >= warm_rounds) {
      ASSERT_EQ(count, 0u) << stacks;
    }
  }
  EXPECT_EQ(quiet, kQuietRounds) << stacks;
}

INSTANTIATE_TEST_SUITE_P(Threads, HeapUseTest, testing::Values(1, 2));

/// The guard itself sees what it has to see.
TEST(HeapUse, SeesEveryWayToTheHeap) {
  if (!heap_use_is_counted()) GTEST_SKIP() << "malloc is the sanitizer's here and cannot be counted";
  const HeapUse use;
  std::vector<void*> places;  // which the compiler must not leave out
  places.reserve(10);
  EXPECT_EQ(use.count(), 1u);
  places.push_back(std::malloc(100));
  places.push_back(std::calloc(10, 10));
  places.push_back(std::realloc(nullptr, 100));
  places.push_back(std::aligned_alloc(64, 64));
  places.push_back(nullptr);
  EXPECT_EQ(posix_memalign(&places.back(), 64, 64), 0);
  EXPECT_EQ(use.count(), 6u);
  for (void* place : places) std::free(place);
  const std::string by_the_library = std::string(100, 'x') + std::to_string(use.count());
  EXPECT_EQ(by_the_library.back(), '6');
  EXPECT_GT(use.count(), 6u);
  std::jthread([] {}).join();
  EXPECT_NE(use.stacks(), "");
}

}  // namespace
}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/run_beside.hpp"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "service/pipeline/detect_handles.hpp"
#include "tests/support/clouds.hpp"
#include "tests/support/scene_gallery.hpp"

namespace graspd {
namespace {

TEST(RunBeside, DoesAll) {
  std::atomic<int> sum = 0;
  run_beside([&] { sum += 1; }, [&] { sum += 2; }, [&] { sum += 4; });
  EXPECT_EQ(sum, 7);
}

TEST(RunBeside, LoopsOfTheOthersAreDoneToTheEnd) {
  using std::chrono_literals::operator""ms;
  constexpr int kSteps = 1000, kMostWaits = 100;
  for (int round = 0; round < 3; ++round) {
    std::atomic<bool> throws = false;
    std::atomic<int> done = 0;
    const auto loop = [&] {
      // On a single thread it never comes to that.
      for (int i = 0; i < kMostWaits && !throws; ++i) std::this_thread::sleep_for(1ms);
      std::this_thread::sleep_for(5ms);
      tbb::parallel_for(0, kSteps, [&](int) { ++done; });
    };
    const auto fail = [&] {
      throws = true;
      throw std::runtime_error("fail");
    };
    EXPECT_THROW(run_beside(loop, fail, loop), std::runtime_error);
    EXPECT_EQ(done, 2 * kSteps);
  }
}

TEST(RunBeside, ThrowsWhatTheFirstOfThemThrew) {
  const auto fail = [](const char* what) { throw std::runtime_error(what); };
  try {
    run_beside([] {}, [&] { fail("second"); }, [&] { fail("third"); });
    FAIL() << "nothing thrown";
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(), "second");
  }
}

/// A frame that is given up ends after any stage.
TEST(DetectHandles, EndsAfterAnyStageWhenTheObserverThrows) {
  struct GivenUp {};
  const PointCloud cloud = render(three_objects()).cloud;
  int num_stages = 0;
  ASSERT_FALSE(detect_handles(cloud, {}, {}, [&](std::string_view) { ++num_stages; }).handles.empty());
  for (int round = 0; round < 10; ++round)
    for (int last = 0; last < num_stages; ++last) {
      int stage = 0;
      const auto give_up = [&](std::string_view) {
        if (stage++ == last) throw GivenUp{};
      };
      EXPECT_THROW((void)detect_handles(cloud, {}, {}, give_up), GivenUp);
    }
}

}  // namespace
}  // namespace graspd

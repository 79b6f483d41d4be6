// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/runtime/process_usage.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstddef>
#include <future>
#include <thread>
#include <vector>

#include "tests/unit/runtime/manual_clock.hpp"

namespace graspd {
namespace {

using namespace std::chrono_literals;

TEST(ProcessUsage, ReadsTheKernelsLines) {
  const char* text = "Name:\tgraspd\nVmPeak:\t  999 kB\nVmHWM:\t    2048 kB\nVmRSS:\t    1024 kB\n";
  EXPECT_EQ(status_bytes(text, "VmRSS"), 1024 * 1024);
  EXPECT_EQ(status_bytes(text, "VmHWM"), 2048 * 1024);
  EXPECT_EQ(status_bytes(text, "VmSwap"), 0);
  EXPECT_EQ(status_bytes("", "VmRSS"), 0);
  EXPECT_EQ(status_number("VmRSS:\t 1 kB\nThreads:\t17\n", "Threads"), 17);
}

TEST(ProcessUsage, CountsThreadsAndDescriptors) {
  ManualClock clock;
  ProcessUsageMeter meter;
  const ProcessUsage before = meter.measure(clock.now());
  EXPECT_GE(before.threads, 1);
  EXPECT_GE(before.descriptors, 3);
  const int copy = dup(0);
  std::promise<void> end;
  std::thread thread([&] { end.get_future().wait(); });
  const ProcessUsage after = meter.measure(clock.now());
  EXPECT_EQ(after.descriptors, before.descriptors + 1);
  EXPECT_EQ(after.threads, before.threads + 1);
  end.set_value();
  thread.join();
  close(copy);
}

TEST(ProcessUsage, SeesMemoryThatIsUsed) {
  ManualClock clock;
  ProcessUsageMeter meter;
  const ProcessUsage before = meter.measure(clock.now());
  EXPECT_GT(before.rss_bytes, 0);
  EXPECT_GE(before.peak_rss_bytes, before.rss_bytes);
  EXPECT_EQ(before.cpu, 0);
  constexpr std::size_t kBytes = std::size_t{256} << 20;
  const std::vector<char> block(kBytes, 1);
  clock.advance(1s);
  const ProcessUsage after = meter.measure(clock.now());
  EXPECT_GE(after.peak_rss_bytes, static_cast<std::int64_t>(kBytes));
  EXPECT_EQ(block[kBytes / 2], 1);
  EXPECT_GT(after.cpu, 0);
}

}  // namespace
}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/runtime/free_cores.hpp"

#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstddef>
#include <thread>

namespace graspd {
namespace {

constexpr auto kStat =
    "cpu  9000 900 900 9000 900 900 900 900 0 0\n"
    "cpu0 100 20 30 4000 500 6 7 8 90 10\n"
    "cpu1 1 2 3 4 5 6 7 8 9 10\n"
    "cpu11 1000 0 0 0 0 0 0 0 0 0\n"
    "intr 12345 0 9\n"
    "ctxt 1990473\n";

TEST(FreeCores, AddsUpWhatIsNeitherIdleNorGivesWay) {
  EXPECT_EQ(busy_ticks(kStat, {0}, false), 100 + 30 + 6 + 7 + 8)
      << "not nice, idle, iowait and the guests' parts of user";
  EXPECT_EQ(busy_ticks(kStat, {1}, false), 1 + 3 + 6 + 7 + 8);
  EXPECT_EQ(busy_ticks(kStat, {0, 1}, false), busy_ticks(kStat, {0}, false) + busy_ticks(kStat, {1}, false));
  EXPECT_EQ(busy_ticks(kStat, {11}, false), 1000);
  EXPECT_EQ(busy_ticks(kStat, {2}, false), 0) << "not there";
  EXPECT_EQ(busy_ticks(kStat, {}, false), 0);
}

TEST(FreeCores, ANicedProgramCountsOthersThatAreTooAsBusy) {
  EXPECT_EQ(busy_ticks(kStat, {0}, true), busy_ticks(kStat, {0}, false) + 20);
  EXPECT_EQ(busy_ticks(kStat, {11}, true), 1000);
}

TEST(FreeCores, TakesTextsThatAreCutOffOrEmpty) {
  EXPECT_EQ(busy_ticks("", {0}, false), 0);
  EXPECT_EQ(busy_ticks("cpu0", {0}, false), 0);
  EXPECT_EQ(busy_ticks("cpu0 100 20 3", {0}, false), 103);
  EXPECT_EQ(busy_ticks("cpu0 100 - 3", {0}, false), 100);
}

TEST(FreeCores, AHelperIsWorthHavingWhereMostOfItsCoreIsLeft) {
  EXPECT_EQ(threads_worth_having(2, 2, 2), 2);
  EXPECT_EQ(threads_worth_having(1.3, 2, 2), 2);
  EXPECT_EQ(threads_worth_having(1.2, 2, 2), 1);
  EXPECT_EQ(threads_worth_having(1.4, 1, 2), 1) << "between the limits it stays";
  EXPECT_EQ(threads_worth_having(1.5, 1, 2), 2);
  EXPECT_EQ(threads_worth_having(5.9, 8, 8), 6);
  EXPECT_EQ(threads_worth_having(8, 2, 4), 4) << "no more than there may be";
  EXPECT_EQ(threads_worth_having(0, 2, 2), 1) << "its own thread always";
  for (double free_cores = 0; free_cores <= 8; free_cores += 0.125)
    for (int now = 1; now <= 8; ++now) {
      const int threads = threads_worth_having(free_cores, now, 8);
      EXPECT_EQ(threads_worth_having(free_cores, threads, 8), threads) << "it settles at once";
    }
}

TEST(FreeCores, AllAreTakenForFreeUntilThereIsAFigure) {
  FreeCores meter;
  EXPECT_EQ(meter.look(), static_cast<double>(usable_cores().size()));
}

/// A process that never sleeps, on one core, until it goes.
class Hog {
 public:
  explicit Hog(int core) : pid_(fork()) {
    if (pid_ != 0) return;
    cpu_set_t set;
    CPU_ZERO(&set);
    CPU_SET(static_cast<std::size_t>(core), &set);
    if (sched_setaffinity(0, sizeof(set), &set) != 0) _exit(1);
    for (volatile unsigned turns = 0;;) turns = turns + 1;
  }
  Hog(const Hog&) = delete;
  Hog& operator=(const Hog&) = delete;
  ~Hog() {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }

 private:
  pid_t pid_;
};

TEST(FreeCores, ACoreThatAnotherProcessKeepsBusyIsNotFree) {
  const auto cores = usable_cores();
  ASSERT_FALSE(cores.empty());
  const Hog hog(cores.front());
  std::this_thread::sleep_for(FreeCores::kShortest / 3);  // until it is on its core
  FreeCores meter;
  std::this_thread::sleep_for(2 * FreeCores::kShortest);
  const double free_cores = meter.look();
  EXPECT_GE(free_cores, 0);
  EXPECT_LE(free_cores, static_cast<double>(cores.size()) - 0.7);
  EXPECT_EQ(meter.look(), free_cores) << "kept until there is enough time for another";
}

}  // namespace
}  // namespace graspd

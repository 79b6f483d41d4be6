// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/common/stop_flag.hpp"

#include <algorithm>
#include <atomic>
#include <csignal>
#include <thread>

namespace graspd {
namespace {

// A signal handler reaches nothing but static storage, and LCM's own thread may be the one that is
// interrupted.
std::atomic<bool> stop_flag = false;
static_assert(std::atomic<bool>::is_always_lock_free);

void request_stop(int) {
  stop_flag = true;
}

}  // namespace

void catch_stop_signals() {
  struct sigaction action {};
  action.sa_handler = request_stop;
  sigemptyset(&action.sa_mask);
  // No SA_RESTART: system calls that wait come back to look at the flag.
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool stop_requested() {
  return stop_flag;
}

bool wait_until(std::chrono::steady_clock::time_point time) {
  constexpr std::chrono::milliseconds kSlice{20};
  while (!stop_requested()) {
    const auto now = std::chrono::steady_clock::now();
    if (now >= time) return true;
    std::this_thread::sleep_until(std::min(time, now + kSlice));
  }
  return false;
}

}  // namespace graspd

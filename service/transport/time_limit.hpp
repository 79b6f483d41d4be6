// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// An end for calls into a library that wait for another machine as long as that likes.
#pragma once
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace graspd {

/// When it has lived for so long, system calls in which its thread waits end with EINTR, again and again
/// until it goes. For use on one thread, around calls that take EINTR for a failure; its signal is SIGURG,
/// which nothing else here uses.
class TimeLimit {
 public:
  explicit TimeLimit(std::chrono::milliseconds limit);
  ~TimeLimit();
  TimeLimit(const TimeLimit&) = delete;
  TimeLimit& operator=(const TimeLimit&) = delete;

  [[nodiscard]] bool passed() const { return passed_; }

 private:
  void interrupt(std::chrono::steady_clock::time_point end, pthread_t thread);

  std::mutex mutex_;
  std::condition_variable changed_;
  bool over_ = false;
  std::atomic<bool> passed_ = false;
  std::thread watch_;
};

}  // namespace graspd

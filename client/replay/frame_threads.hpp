// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Threads that each work on one frame at a time.
#pragma once
#include <oneapi/tbb/global_control.h>

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <future>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "graspd/handle_list_t.hpp"

namespace graspd {

/// An answer and its message, ready to be written.
struct EncodedAnswer {
  std::string handles_channel;
  handle_list_t list;
  std::vector<std::byte> message;  ///< that says the list
};

/// While it lives, no frame is split over several threads: throughput is what counts offline.
class FrameThreads {
 public:
  explicit FrameThreads(int threads);
  ~FrameThreads();  ///< Forgets what has not begun, waits for the rest.
  FrameThreads(const FrameThreads&) = delete;
  FrameThreads& operator=(const FrameThreads&) = delete;

  [[nodiscard]] std::future<EncodedAnswer> start(std::function<EncodedAnswer()> work);

 private:
  void run();

  tbb::global_control alone_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::packaged_task<EncodedAnswer()>> waiting_;
  bool ends_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace graspd

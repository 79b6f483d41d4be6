// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/replay/frame_threads.hpp"

#include <utility>

namespace graspd {

FrameThreads::FrameThreads(int threads) : alone_(tbb::global_control::max_allowed_parallelism, 1) {
  for (int i = 0; i < threads; ++i) threads_.emplace_back([this] { run(); });
}

FrameThreads::~FrameThreads() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
    waiting_.clear();
  }
  changed_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

std::future<EncodedAnswer> FrameThreads::start(std::function<EncodedAnswer()> work) {
  std::packaged_task<EncodedAnswer()> task(std::move(work));
  std::future<EncodedAnswer> result = task.get_future();
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(task));
  }
  changed_.notify_one();
  return result;
}

void FrameThreads::run() {
  while (true) {
    std::packaged_task<EncodedAnswer()> task;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return ends_ || !waiting_.empty(); });
      if (ends_) return;
      task = std::move(waiting_.front());
      waiting_.pop_front();
    }
    task();
  }
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Threads that work on what a FrameQueue holds.
#pragma once
#include <cstddef>
#include <functional>
#include <thread>
#include <utility>
#include <vector>

#include "service/runtime/frame_queue.hpp"

namespace graspd {

/// Runs until the queue is closed and empty. The destructor waits for that.
template <class Item>
class WorkerPool {
 public:
  /// Must not throw: what a frame can do wrong is an answer, anything else a bug.
  using Work = std::function<void(Item)>;

  WorkerPool(FrameQueue<Item>& queue, std::size_t workers, Work work)
      : queue_(queue), work_(std::move(work)) {
    threads_.reserve(workers);
    for (std::size_t i = 0; i < workers; ++i) threads_.emplace_back([this]() noexcept { run(); });
  }
  ~WorkerPool() {
    queue_.close();
    for (std::thread& thread : threads_) thread.join();
  }
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

 private:
  void run() {
    while (auto taken = queue_.take()) {
      const std::size_t source = taken->source;
      work_(std::move(taken->item));
      queue_.done(source);
    }
  }

  FrameQueue<Item>& queue_;
  const Work work_;
  std::vector<std::thread> threads_;
};

}  // namespace graspd

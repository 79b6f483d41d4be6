// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/runtime/worker_pool.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <random>
#include <thread>
#include <vector>

#include "service/runtime/in_order_gate.hpp"

namespace graspd {
namespace {

using namespace std::chrono_literals;

struct Frame {
  std::size_t source = 0;
  std::uint64_t ticket = 0;
  int number = 0;
};

/// What the daemon does, with numbers for frames: mailboxes, workers, a gate a source.
class Service {
 public:
  Service(std::size_t sources, std::size_t capacity, std::size_t in_flight, std::size_t workers)
      : out_(sources), in_flight_(sources) {
    for (std::size_t s = 0; s < sources; ++s) {
      queue_.add_source(capacity, in_flight);
      gates_.push_back(
          std::make_unique<InOrderGate<int>>([this, s](int result) { out_[s].push_back(result); }));
      in_flight_[s] = 0;
    }
    pool_ = std::make_unique<WorkerPool<Frame>>(queue_, workers, [this](Frame frame) { work(frame); });
  }

  void send(std::size_t source, int number) {
    const Frame frame{source, gates_[source]->take_ticket(), number};
    if (const auto dropped = queue_.push(source, frame)) {
      ++dropped_;
      gates_[source]->release(dropped->ticket, -dropped->number);
    }
  }
  void stop() { pool_.reset(); }

  std::vector<std::vector<int>> out_;
  std::atomic<int> dropped_ = 0;
  std::atomic<int> worked_ = 0;
  std::atomic<int> most_in_flight_ = 0;

 private:
  void work(const Frame& frame) {
    const int now = ++in_flight_[frame.source];
    int most = most_in_flight_;
    while (now > most && !most_in_flight_.compare_exchange_weak(most, now)) {
    }
    if (frame.number % 7 == 0) std::this_thread::yield();
    --in_flight_[frame.source];
    ++worked_;
    gates_[frame.source]->release(frame.ticket, frame.number);
  }

  std::vector<std::atomic<int>> in_flight_;
  FrameQueue<Frame> queue_;
  std::vector<std::unique_ptr<InOrderGate<int>>> gates_;
  std::unique_ptr<WorkerPool<Frame>> pool_;
};

TEST(WorkerPool, EveryFrameIsAnsweredOnceAndInOrder) {
  constexpr std::size_t kSources = 3;
  constexpr int kFrames = 2000;
  Service service(kSources, 4, 4, 4);
  for (int i = 1; i <= kFrames; ++i) {
    for (std::size_t s = 0; s < kSources; ++s) service.send(s, i);
    // Mixed: bursts that overflow the mailboxes, and times when the workers catch up.
    while (service.worked_ < i) std::this_thread::yield();
  }
  service.stop();
  int dropped = 0;
  for (const auto& out : service.out_) {
    ASSERT_EQ(out.size(), static_cast<std::size_t>(kFrames));
    for (int i = 1; i <= kFrames; ++i) {
      const int answer = out[static_cast<std::size_t>(i - 1)];
      ASSERT_TRUE(answer == i || answer == -i);
      dropped += answer < 0 ? 1 : 0;
    }
  }
  EXPECT_EQ(dropped, service.dropped_);
  EXPECT_LE(service.most_in_flight_, 4);
}

TEST(WorkerPool, LatestPolicyKeepsOneInFlight) {
  Service service(2, 1, 1, 4);
  for (int i = 1; i <= 2000; ++i) {
    service.send(0, i);
    service.send(1, i);
  }
  service.stop();
  EXPECT_EQ(service.most_in_flight_, 1);
  // The newest frame is never the one that goes.
  EXPECT_EQ(service.out_[0].back(), 2000);
  EXPECT_EQ(service.out_[1].back(), 2000);
}

TEST(WorkerPool, StopFinishesWhatWaits) {
  FrameQueue<int> queue;
  const std::size_t source = queue.add_source(100, 2);
  for (int i = 0; i < 100; ++i) ASSERT_FALSE(queue.push(source, i));
  std::atomic<int> sum = 0;
  {
    const WorkerPool<int> pool(queue, 2, [&](int i) { sum += i; });
  }
  EXPECT_EQ(sum, 4950);
}

TEST(WorkerPool, DroppedFramesNeverReachAWorker) {
  FrameQueue<int> queue;
  const std::size_t source = queue.add_source(100, 1);
  std::mutex hold;
  std::atomic<int> worked = 0;
  std::unique_lock lock(hold);
  for (int i = 0; i < 10; ++i) ASSERT_FALSE(queue.push(source, i));
  WorkerPool<int> pool(queue, 2, [&](int) {
    ++worked;
    const std::lock_guard wait(hold);
  });
  while (worked == 0) std::this_thread::yield();
  queue.close();
  EXPECT_EQ(queue.drop_waiting().size(), 9u);
  lock.unlock();
  EXPECT_TRUE(queue.wait_idle(60s));
  EXPECT_EQ(worked, 1);
}

}  // namespace
}  // namespace graspd

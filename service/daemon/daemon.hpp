// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The wiring: LCM thread -> mailboxes -> workers -> gates -> LCM.
#pragma once
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "service/config/service_config.hpp"
#include "service/daemon/authentication.hpp"
#include "service/daemon/health.hpp"
#include "service/daemon/stream.hpp"
#include "service/runtime/clock.hpp"
#include "service/runtime/frame_queue.hpp"
#include "service/runtime/log.hpp"
#include "service/runtime/worker_pool.hpp"
#include "service/transport/lcm_bus.hpp"

namespace graspd {

/// Subscribes when made. Belongs to one thread, the LCM thread; bus, clock and log must outlive it.
class Daemon {
 public:
  Daemon(ServiceConfig config, LcmBus& bus, const Clock& clock, Log& log);
  Daemon(const Daemon&) = delete;
  Daemon& operator=(const Daemon&) = delete;

  /// Waits for one message, at most a twentieth of a second, and publishes the status when a second is over.
  LcmBus::Wait step();

  /// Takes no more messages, finishes or drops those that have been taken, publishes the last status. Each
  /// has its answer then. False when a worker is still at a frame after 1.4 s: the destructor would wait for
  /// it.
  [[nodiscard]] bool stop();

 private:
  void subscribe();
  void on_packet(std::size_t source, const Packet& packet);
  Stream* stream_for(std::size_t source, const Packet& packet);
  Stream& add_stream(std::size_t source, const std::string& channel);
  void take(Stream& stream, const Packet& packet);
  void work(Job job);
  void publish(Stream& stream, Answer answer);
  void drop(const Job& job, const std::string& why);
  void answer_for_workers();
  void publish_status(std::int8_t state);
  [[nodiscard]] bool is_own_channel(const std::string& channel) const;
  [[nodiscard]] Clock::TimePoint arrival_of(const Packet& packet) const;

  const ServiceConfig config_;
  LcmBus& bus_;
  const Clock& clock_;
  Log& log_;
  tbb::global_control helpers_;  // one thread less than a frame may have; all workers share them
  tbb::task_arena arena_;        // with a place for each worker, so that none waits for another's frame
  ProcessHealth health_;
  Authentication authentication_;
  std::vector<std::unique_ptr<Stream>>
      streams_;  // in order of their first message; read and written by the LCM thread
  std::map<std::string, Stream*, std::less<>> stream_of_channel_;
  std::int64_t ignored_ = 0;
  Clock::TimePoint next_status_;
  bool stopped_ = false;
  std::atomic<bool> cancelled_ = false;
  std::mutex in_work_mutex_;
  std::set<const Job*> in_work_;
  FrameQueue<Job> queue_;
  WorkerPool<Job> workers_;  // last: its threads use all of the above
};

/// Threads that one frame is split over at most: as configured, one a core for 0.
[[nodiscard]] int threads_a_frame(const ServiceConfig& config);

}  // namespace graspd

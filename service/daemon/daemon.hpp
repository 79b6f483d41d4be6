// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The wiring: LCM thread -> mailboxes -> workers -> gates -> LCM.
#pragma once
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>

#include "service/config/service_config.hpp"
#include "service/daemon/authentication.hpp"
#include "service/daemon/config_control.hpp"
#include "service/daemon/health.hpp"
#include "service/daemon/segmentation_requests.hpp"
#include "service/daemon/stream.hpp"
#include "service/daemon/stream_table.hpp"
#include "service/daemon/work_watch.hpp"
#include "service/runtime/byte_budget.hpp"
#include "service/runtime/clock.hpp"
#include "service/runtime/clock_watch.hpp"
#include "service/runtime/frame_queue.hpp"
#include "service/runtime/free_cores.hpp"
#include "service/runtime/log.hpp"
#include "service/runtime/worker_pool.hpp"
#include "service/transport/bus.hpp"

namespace graspd {

/// Subscribes when made. Belongs to one thread, the LCM thread; bus, clock and log must outlive it.
class Daemon {
 public:
  /// `load` reads the configuration anew; without it there is only the one that is given.
  Daemon(ServiceConfig config, Bus& bus, const Clock& clock, Log& log, ConfigControl::Load load = {});
  Daemon(const Daemon&) = delete;
  Daemon& operator=(const Daemon&) = delete;

  /// Waits for one message, at most a twentieth of a second; does what control messages ask for, answers for
  /// frames that take too long, publishes the status when a second is over.
  Bus::Wait step();

  /// Reads the configuration again and takes it, or keeps the old one; log and status say which.
  void reload();

  /// Takes no more messages, finishes or drops those that have been taken, publishes the last status. Each
  /// has its answer then. False when a worker is still at a frame after 1.4 s: the destructor would wait for
  /// it.
  [[nodiscard]] bool stop();

  /// Frames in work for longer than watchdog_s.
  [[nodiscard]] int num_stuck() const { return num_stuck_; }
  /// One line for people about the newest status.
  [[nodiscard]] const std::string& summary() const { return summary_; }
  /// How many statuses there were.
  [[nodiscard]] std::int64_t num_statuses() const { return num_statuses_; }

 private:
  void adopt(std::shared_ptr<const ServiceConfig> config, std::int64_t revision);
  void change_config(const std::string& cause, const std::function<ConfigControl::Proposal()>& propose);
  void keep_fixed_settings(ServiceConfig& config);
  void on_packet(const std::string& subscription, const Packet& packet);
  void on_control(const Packet& packet);
  void on_request(const Packet& packet);
  void obey_controls();
  void take(const std::shared_ptr<Stream>& stream, const Packet& packet);
  void hold_answers_within_limit(Stream& stream);
  std::optional<ByteBudget::Lease> take_memory(const Stream& stream, std::size_t bytes);
  void work(Job job);
  Answer work_on(const Job& job, const std::atomic<bool>& cancelled);
  void watch_work();
  void look_at_clock();
  void look_at_cores();
  void publish(Stream& stream, Answer answer);
  void send(const std::string& channel, std::span<const std::byte> bytes);
  void follow_load(Stream& stream, const Answer& answer, double latency_s);
  static void drop(const Job& job, DropReason reason, const std::string& why);
  [[nodiscard]] std::vector<source_status_t> source_statuses();
  void publish_status(std::int8_t state);
  [[nodiscard]] Clock::TimePoint arrival_of(const Packet& packet);

  Bus& bus_;
  const Clock& clock_;
  Log& log_;
  std::shared_ptr<const ServiceConfig> config_;
  ConfigControl control_;
  Authentication authentication_;
  SegmentationRequests requests_;
  std::set<std::string> subscriptions_;
  std::deque<control_t> controls_;  // that have arrived and are not obeyed yet
  const int most_threads_;          // that a frame may have
  tbb::global_control helpers_;     // one thread less than a frame may have; all workers share them
  std::optional<tbb::global_control> fewer_helpers_;  // while others keep cores busy
  FreeCores free_cores_;
  int threads_ = 0;        // that a frame has now
  tbb::task_arena arena_;  // with a place for each worker, so that none waits for another's frame
  ProcessHealth health_;
  ClockWatch clock_watch_;
  ByteBudget budget_;
  Clock::TimePoint next_status_;
  std::string summary_;
  std::int64_t num_statuses_ = 0;
  int num_stuck_ = 0;
  bool stopped_ = false;
  WorkWatch work_watch_;
  FrameQueue<Job> queue_;
  StreamTable table_;
  WorkerPool<Job> workers_;  // last: its threads use all of the above
};

/// Threads that one frame is split over at most: as configured, one a core for 0.
[[nodiscard]] int threads_a_frame(const ServiceConfig& config);

}  // namespace graspd

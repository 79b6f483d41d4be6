// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The whole daemon in one process, over memq://, with a clock that a test can move and hold.
#pragma once
#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "service/daemon/daemon.hpp"
#include "service/runtime/clock.hpp"
#include "service/runtime/log.hpp"
#include "service/transport/lcm_bus.hpp"
#include "tests/unit/daemon/messages.hpp"

namespace graspd {

/// The machine's clocks and what a test adds. A frame can be held in the middle of its work: the workers ask
/// for the time, and wait there.
class TestClock final : public Clock {
 public:
  [[nodiscard]] TimePoint now() const override;
  [[nodiscard]] std::int64_t wall_utime() const override;

  /// The steady clock alone: LCM stamps messages with the machine's wall clock.
  void advance(std::chrono::microseconds by);
  void set_wall(std::chrono::microseconds by);

  /// From now on the first frame that comes to its decoding stays there.
  void hold_next_frame();
  [[nodiscard]] bool holds() const;
  void release();

 private:
  // A worker asks when it begins with a frame, for the frame's age, and when it decodes.
  static constexpr int kCallsToDecoding = 3;

  const std::thread::id owner_ = std::this_thread::get_id();
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::chrono::microseconds offset_{0};
  std::chrono::microseconds wall_offset_{0};
  mutable int calls_left_ = 0;
  mutable bool holding_ = false;
  bool armed_ = false;
};

class RunningDaemon : public testing::Test {
 protected:
  RunningDaemon();
  ~RunningDaemon() override { clock_.release(); }

  void start(ServiceConfig config, ConfigControl::Load load = {});
  void send(const std::string& channel, const Bytes& bytes) { ASSERT_TRUE(bus_.publish(channel, bytes)); }
  /// A frame that the daemon has taken in, too.
  void send_and_step(std::int64_t seq);

  template <class Condition>
  void run_until(Condition condition) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(120);
    while (!condition()) {
      ASSERT_LT(std::chrono::steady_clock::now(), deadline) << "waited in vain";
      daemon_->step();
    }
  }
  void run_until_answers(std::size_t count) {
    run_until([&] { return answers_.size() >= count; });
  }
  /// A frame that is in work until the clock is released.
  void hold_frame(std::int64_t seq);
  /// The next status.
  void run_until_status();
  /// What the daemon sent, without its doing anything more.
  void receive_rest();
  [[nodiscard]] std::vector<std::int64_t> answered_seqs() const;
  [[nodiscard]] bool logged(const std::string& text);

  LcmBus bus_{"memq://"};
  TestClock clock_;
  std::vector<std::string> lines_;
  std::mutex lines_mutex_;
  Log log_{clock_, [this](const std::string& line) {
             const std::lock_guard lock(lines_mutex_);
             lines_.push_back(line);
           }};
  std::vector<handle_list_t> answers_;
  std::vector<status_t> statuses_;
  std::unique_ptr<Daemon> daemon_;  // last: it stops before what it uses goes
};

/// 0 to count - 1.
[[nodiscard]] std::vector<std::int64_t> numbers_to(std::int64_t count);

}  // namespace graspd

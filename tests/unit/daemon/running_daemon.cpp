// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/daemon/running_daemon.hpp"

#include <algorithm>
#include <utility>

#include "service/transport/handle_list_codec.hpp"
#include "service/transport/status_codec.hpp"

namespace graspd {

using namespace std::chrono_literals;

Clock::TimePoint TestClock::now() const {
  std::unique_lock lock(mutex_);
  if (armed_ && std::this_thread::get_id() != owner_ && --calls_left_ == 0) {
    holding_ = true;
    changed_.wait(lock, [this] { return !armed_; });
    holding_ = false;
  }
  return std::chrono::steady_clock::now() + offset_;
}

std::int64_t TestClock::wall_utime() const {
  const std::lock_guard lock(mutex_);
  return SystemClock().wall_utime() + wall_offset_.count();
}

void TestClock::advance(std::chrono::microseconds by) {
  const std::lock_guard lock(mutex_);
  offset_ += by;
}

void TestClock::set_wall(std::chrono::microseconds by) {
  const std::lock_guard lock(mutex_);
  wall_offset_ += by;
}

void TestClock::hold_next_frame() {
  const std::lock_guard lock(mutex_);
  armed_ = true;
  calls_left_ = kCallsToDecoding;
}

bool TestClock::holds() const {
  const std::lock_guard lock(mutex_);
  return holding_;
}

void TestClock::release() {
  {
    const std::lock_guard lock(mutex_);
    armed_ = false;
  }
  changed_.notify_all();
}

RunningDaemon::RunningDaemon() {
  bus_.subscribe(".*_HANDLES", [this](const Packet& packet) {
    const auto list = decode_handle_list(packet.bytes);
    ASSERT_TRUE(list);
    answers_.push_back(*list);
  });
  bus_.subscribe("GRASPD_STATUS", [this](const Packet& packet) {
    const auto status = decode_status(packet.bytes);
    ASSERT_TRUE(status);
    statuses_.push_back(*status);
  });
}

void RunningDaemon::start(ServiceConfig config, ConfigControl::Load load) {
  config.threads = 2;
  daemon_ = std::make_unique<Daemon>(std::move(config), bus_, clock_, log_, std::move(load));
}

void RunningDaemon::send_and_step(std::int64_t seq) {
  const std::size_t waiting_before = answers_.size();
  send("GRASPD_CLOUD", cloud_message(seq, box_on_table()));
  // In memq everything comes in the order it was sent in: this marker after the frame.
  bool taken = false;
  bus_.subscribe("MARKER", [&](const Packet&) { taken = true; });
  send("MARKER", {});
  run_until([&] { return taken; });
  bus_.unsubscribe("MARKER");
  ASSERT_GE(answers_.size(), waiting_before);
}

void RunningDaemon::hold_frame(std::int64_t seq) {
  clock_.hold_next_frame();
  send("GRASPD_CLOUD", cloud_message(seq, box_on_table()));
  run_until([this] { return clock_.holds(); });
}

void RunningDaemon::run_until_status() {
  const std::size_t before = statuses_.size();
  run_until([&] { return statuses_.size() > before; });
}

void RunningDaemon::receive_rest() {
  while (bus_.wait(0ms) == Bus::Wait::kHandled) {
  }
}

std::vector<std::int64_t> RunningDaemon::answered_seqs() const {
  std::vector<std::int64_t> seqs;
  for (const handle_list_t& list : answers_) seqs.push_back(list.seq);
  return seqs;
}

bool RunningDaemon::logged(const std::string& text) {
  const std::lock_guard lock(lines_mutex_);
  return std::any_of(lines_.begin(), lines_.end(),
                     [&](const std::string& line) { return line.find(text) != std::string::npos; });
}

std::vector<std::int64_t> numbers_to(std::int64_t count) {
  std::vector<std::int64_t> numbers;
  for (std::int64_t i = 0; i < count; ++i) numbers.push_back(i);
  return numbers;
}

}  // namespace graspd

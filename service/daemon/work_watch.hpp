// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The frames that workers are at, and for how long.
#pragma once
#include <atomic>
#include <functional>
#include <list>
#include <memory_resource>
#include <mutex>

#include "service/daemon/stream.hpp"
#include "service/runtime/clock.hpp"

namespace graspd {

/// All functions may be called from any thread. Callbacks answer for the worker and must not throw; the frame
/// is told to end after the stage it is in.
class WorkWatch {
 public:
  using Answerer = std::function<void(const Job&)>;

  struct Work {
    const Job* job = nullptr;
    Clock::TimePoint begin{};
    std::atomic<bool> cancelled = false;
    bool late = false;
    bool stuck = false;
  };

  /// A worker is at the job for as long as this lives.
  class Entry {
   public:
    Entry(WorkWatch& watch, const Job& job, Clock::TimePoint now);
    ~Entry();
    Entry(const Entry&) = delete;
    Entry& operator=(const Entry&) = delete;
    [[nodiscard]] const std::atomic<bool>& cancelled() const { return at_->cancelled; }

   private:
    WorkWatch& watch_;
    std::pmr::list<Work>::iterator at_;
  };

  /// Gives up frames that are past their deadline, and those in work for longer than `longest` (zero: no
  /// limit). Each is handed over once, to one of the two. How many are in work for too long.
  int look(Clock::TimePoint now, Clock::TimePoint::duration longest, const Answerer& late,
           const Answerer& stuck);
  /// Gives up the frames of a stream.
  void give_up(const Stream& stream, const Answerer& answer);
  /// Gives up all frames.
  void give_up_all(const Answerer& answer);
  /// Tells all frames, also those that begin later, to end after their stage.
  void cancel_all();

 private:
  std::mutex mutex_;
  std::pmr::list<Work> works_;
  bool all_cancelled_ = false;
};

}  // namespace graspd

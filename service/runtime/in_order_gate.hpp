// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Lets results out in the order their frames came in, whatever order the workers finish in.
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory_resource>
#include <mutex>
#include <utility>

namespace graspd {

/// One a source. Every ticket has to be released once, also a dropped frame's, or the gate stays shut behind
/// it. All functions may be called from any thread.
template <class Result>
class InOrderGate {
 public:
  using Ticket = std::uint64_t;
  /// Called in ticket order, one call at a time, from whichever thread releases; must not throw.
  using Publish = std::function<void(Result)>;

  explicit InOrderGate(Publish publish) : publish_(std::move(publish)) {}

  [[nodiscard]] Ticket take_ticket() {
    const std::lock_guard lock(mutex_);
    return next_ticket_++;
  }

  /// Publishes the result now if it is its turn, with those that waited behind it. Of several releases of a
  /// ticket the first one counts: so a frame that takes too long can be answered for its worker.
  void release(Ticket ticket, Result result) {
    std::unique_lock lock(mutex_);
    if (ticket < next_out_ || !waiting_.try_emplace(ticket, std::move(result)).second) return;
    if (publishing_) return;  // the thread that is at it goes on with this one
    publishing_ = true;
    while (!waiting_.empty() && waiting_.begin()->first == next_out_) {
      auto ready = waiting_.extract(waiting_.begin());
      ++next_out_;
      lock.unlock();
      publish_(std::move(ready.mapped()));
      lock.lock();
    }
    publishing_ = false;
  }

  /// Results that wait for one before them.
  [[nodiscard]] std::size_t waiting() const {
    const std::lock_guard lock(mutex_);
    return waiting_.size();
  }

 private:
  const Publish publish_;
  mutable std::mutex mutex_;
  std::pmr::map<Ticket, Result> waiting_;
  Ticket next_ticket_ = 0;
  Ticket next_out_ = 0;
  bool publishing_ = false;
};

}  // namespace graspd

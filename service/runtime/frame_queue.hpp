// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Mailboxes of several sources, emptied by several workers in turn.
#pragma once
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "service/runtime/mailbox.hpp"

namespace graspd {

/// All functions may be called from any thread.
template <class Item>
class FrameQueue {
 public:
  struct Taken {
    std::size_t source = 0;
    Item item;
  };

  /// `capacity` items wait at most, `max_in_flight` are taken and not done at most. The source's number, from
  /// 0.
  std::size_t add_source(std::size_t capacity, std::size_t max_in_flight) {
    const std::lock_guard lock(mutex_);
    sources_.push_back({Mailbox<Item>(capacity), max_in_flight, 0});
    return sources_.size() - 1;
  }

  /// Changes what add_source() set; the items that had to go, oldest first.
  [[nodiscard]] std::vector<Item> configure(std::size_t source, std::size_t capacity,
                                            std::size_t max_in_flight) {
    std::vector<Item> dropped;
    {
      const std::lock_guard lock(mutex_);
      sources_[source].max_in_flight = max_in_flight;
      dropped = sources_[source].mailbox.set_capacity(capacity);
    }
    changed_.notify_all();
    return dropped;
  }

  /// The item that had to go: the source's oldest waiting one, or after close() this one.
  [[nodiscard]] std::optional<Item> push(std::size_t source, Item item) {
    std::optional<Item> dropped;
    {
      const std::lock_guard lock(mutex_);
      if (closed_) return item;
      dropped = sources_[source].mailbox.push(std::move(item));
    }
    changed_.notify_all();
    return dropped;
  }

  /// Waits for an item; sources take turns. Nothing when closed and empty: the worker ends. Each taken item
  /// needs done().
  [[nodiscard]] std::optional<Taken> take() {
    std::unique_lock lock(mutex_);
    while (true) {
      if (auto taken = take_in_turn()) return taken;
      if (closed_ && all_empty()) return std::nullopt;
      changed_.wait(lock);
    }
  }

  void done(std::size_t source) {
    {
      const std::lock_guard lock(mutex_);
      --sources_[source].in_flight;
    }
    // The source may have items that had to wait for this one, and others wait for all to be done.
    changed_.notify_all();
  }

  /// No more items come in; those that wait can still be taken.
  void close() {
    {
      const std::lock_guard lock(mutex_);
      closed_ = true;
    }
    changed_.notify_all();
  }

  /// Takes the source's oldest waiting item out; nothing when none waits.
  [[nodiscard]] std::optional<Item> drop_oldest(std::size_t source) {
    std::optional<Item> dropped;
    {
      const std::lock_guard lock(mutex_);
      dropped = sources_[source].mailbox.pop();
    }
    changed_.notify_all();
    return dropped;
  }

  /// Takes all waiting items out, oldest first within a source.
  [[nodiscard]] std::vector<Taken> drop_waiting() {
    std::vector<Taken> dropped;
    {
      const std::lock_guard lock(mutex_);
      for (std::size_t i = 0; i < sources_.size(); ++i) {
        while (auto item = sources_[i].mailbox.pop()) dropped.push_back({i, std::move(*item)});
      }
    }
    changed_.notify_all();
    return dropped;
  }

  /// Whether nothing waits and nothing is in flight, now or before the time limit is over.
  [[nodiscard]] bool wait_idle(std::chrono::milliseconds limit) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, limit, [this] { return all_empty() && none_in_flight(); });
  }

 private:
  struct Source {
    Mailbox<Item> mailbox;
    std::size_t max_in_flight;
    std::size_t in_flight;
  };

  std::optional<Taken> take_in_turn() {
    for (std::size_t k = 0; k < sources_.size(); ++k) {
      const std::size_t i = (next_ + k) % sources_.size();
      Source& source = sources_[i];
      if (source.mailbox.empty() || source.in_flight >= source.max_in_flight) continue;
      ++source.in_flight;
      next_ = i + 1;
      return Taken{i, std::move(*source.mailbox.pop())};
    }
    return std::nullopt;
  }
  bool all_empty() const {
    for (const Source& source : sources_)
      if (!source.mailbox.empty()) return false;
    return true;
  }
  bool none_in_flight() const {
    for (const Source& source : sources_)
      if (source.in_flight != 0) return false;
    return true;
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Source> sources_;  // whose mailboxes stay where they are
  std::size_t next_ = 0;        // whose turn it is
  bool closed_ = false;
};

}  // namespace graspd

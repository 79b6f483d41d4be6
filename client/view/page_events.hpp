// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What pages do, handed from the web server's thread to the program's.
#pragma once
#include <cstddef>
#include <deque>
#include <mutex>
#include <utility>
#include <variant>

#include "client/view/commands.hpp"
#include "client/web/web_server.hpp"

namespace graspd {

struct PageOpened {};
struct PageClosed {};

struct PageEvent {
  WebClient client;
  std::variant<PageOpened, PageClosed, Command> what;
};

/// For any thread. Commands beyond a bound are refused; comings and goings, bounded by the server, never.
class PageEvents {
 public:
  static constexpr std::size_t kMost = 1000;

  /// False when it had no room.
  bool put(PageEvent event) {
    const std::scoped_lock lock(mutex_);
    if (std::holds_alternative<Command>(event.what) && events_.size() >= kMost) return false;
    events_.push_back(std::move(event));
    return true;
  }
  [[nodiscard]] std::deque<PageEvent> take_all() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(events_, {});
  }

 private:
  std::mutex mutex_;
  std::deque<PageEvent> events_;
};

}  // namespace graspd

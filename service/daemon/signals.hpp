// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Signals as something to ask for rather than something that interrupts.
#pragma once
#include <csignal>
#include <string_view>

namespace graspd {

/// Blocks SIGINT, SIGTERM and SIGHUP in this thread and in those that it starts, so it has to be made before
/// any other thread is. The process cannot be ended by them from then on: ask received(). SIGPIPE is ignored:
/// a connection that is gone is an error to be told, not the end.
class Signals {
 public:
  Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

  /// The name of a signal that has come since the last call; empty: none.
  [[nodiscard]] std::string_view received() const;

 private:
  sigset_t signals_{};
};

}  // namespace graspd

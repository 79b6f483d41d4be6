// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// SIGINT and SIGTERM as something to ask for rather than something that interrupts.
#pragma once
#include <csignal>
#include <string_view>

namespace graspd {

/// Blocks both signals in this thread and in those that it starts, so it has to be made before any other
/// thread is. The process cannot be ended by them from then on: ask received().
class StopSignals {
 public:
  StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  /// The name of a signal that has come since the last call; empty: none.
  [[nodiscard]] std::string_view received() const;

 private:
  sigset_t signals_{};
};

}  // namespace graspd

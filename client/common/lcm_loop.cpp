// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/common/lcm_loop.hpp"

#include <algorithm>

#include "client/common/program.hpp"
#include "client/common/stop_flag.hpp"

namespace graspd {

LoopEnd run_loop(LcmBus& bus, std::optional<std::chrono::duration<double>> timeout,
                 const std::function<bool()>& done, const std::function<void()>& tick) {
  using Clock = std::chrono::steady_clock;
  using std::chrono::milliseconds;
  const auto start = Clock::now();
  while (!done()) {
    if (stop_requested()) return LoopEnd::kSignal;
    milliseconds wait{100};
    if (timeout) {
      const auto left = std::chrono::ceil<milliseconds>(*timeout - (Clock::now() - start));
      if (left.count() <= 0) return LoopEnd::kTimeout;
      wait = std::min(wait, left);
    }
    if (bus.wait(wait) == LcmBus::Wait::kClosed) return done() ? LoopEnd::kDone : LoopEnd::kClosed;
    if (tick) tick();
  }
  return LoopEnd::kDone;
}

int exit_code(const CLI::App& app, LoopEnd end, const std::string& url) {
  if (end != LoopEnd::kClosed || url.starts_with("file:")) return kExitOk;
  say(app, url + ": the connection was closed");
  return kExitFailed;
}

}  // namespace graspd

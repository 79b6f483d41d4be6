// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// How programs listen: until a count, a time, a signal or the end of the bus.
#pragma once
#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "service/transport/lcm_bus.hpp"

namespace CLI {
class App;
}

namespace graspd {

enum class LoopEnd { kDone, kTimeout, kSignal, kClosed };

/// Hands out messages until done() or another end. tick() runs after each message and at least ten times a
/// second. timeout counts from the start; none: no limit.
[[nodiscard]] LoopEnd run_loop(LcmBus& bus, std::optional<std::chrono::duration<double>> timeout,
                               const std::function<bool()>& done, const std::function<void()>& tick = {});

/// A bus that closed has failed, unless it is a log file that came to its end; that is said on standard
/// error. A signal and a timeout are good ends.
[[nodiscard]] int exit_code(const CLI::App& app, LoopEnd end, const std::string& url);

}  // namespace graspd

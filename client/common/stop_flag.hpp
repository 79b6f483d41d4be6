// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// SIGINT and SIGTERM as a flag that loops look at.
#pragma once
#include <chrono>

namespace graspd {

/// From here on SIGINT and SIGTERM only raise the flag, so that programs end with their summary.
void catch_stop_signals();

[[nodiscard]] bool stop_requested();

/// Waits on the steady clock; false when a stop was requested before the time came.
[[nodiscard]] bool wait_until(std::chrono::steady_clock::time_point time);

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The suites of measurements.
#pragma once
#include <functional>

#include "client/bench/bench_options.hpp"
#include "client/bench/bench_result.hpp"

namespace graspd {

/// Called with each result as soon as it is there.
using ResultSink = std::function<void(BenchResult)>;

/// Stage by stage and whole, for 1, 2, ... all threads.
void run_stages(const BenchOptions& options, const ResultSink& sink);

/// Unorganized clouds of the suite's sizes, with one and all threads; memory while a cloud is worked on.
void run_points(const BenchOptions& options, const ResultSink& sink);

/// Organized images of full and half width, straight from the camera.
void run_organized(const BenchOptions& options, const ResultSink& sink);

/// A message's bytes to the bytes of its handle list, for both types of message.
void run_codec(const BenchOptions& options, const ResultSink& sink);

/// From publishing to the handle list's arrival, through a daemon of its own on a port of its own. Throws
/// std::runtime_error where multicast does not get through or the daemon does not come up.
void run_lcm(const BenchOptions& options, const ResultSink& sink);

/// Runs those that the options choose; a suite that throws std::runtime_error for want of multicast is left
/// out with its reason.
[[nodiscard]] BenchRun run_suites(const BenchOptions& options, const ResultSink& sink);

}  // namespace graspd

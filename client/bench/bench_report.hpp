// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Results for people, as JSON, and as a plot.
#pragma once
#include <string>

#include "client/bench/bench_options.hpp"
#include "client/bench/bench_result.hpp"
#include "client/bench/svg_plot.hpp"

namespace graspd {

/// A table of times with their spread, and a line of figures.
[[nodiscard]] std::string result_table(const BenchResult& result);

[[nodiscard]] std::string bench_json(const BenchRun& run, const BenchOptions& options);

/// Milliseconds against points: graspd whole, its surfaces, PCL.
[[nodiscard]] Plot cost_plot(const BenchRun& run);

}  // namespace graspd

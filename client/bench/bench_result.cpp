// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/bench/bench_result.hpp"

#include <algorithm>

namespace graspd {

void BenchResult::add_time(std::string_view series, double ms) {
  auto it = std::find_if(times.begin(), times.end(), [&](const TimeSeries& t) { return t.name == series; });
  if (it == times.end()) it = times.insert(it, {std::string(series), {}});
  it->ms.add(ms);
}

const Samples* BenchResult::find(std::string_view series) const {
  for (const TimeSeries& t : times)
    if (t.name == series) return &t.ms;
  return nullptr;
}

}  // namespace graspd

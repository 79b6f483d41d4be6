// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/runtime/free_cores.hpp"

#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>

#include "service/runtime/file_text.hpp"
#include "service/runtime/process_usage.hpp"

namespace graspd {
namespace {

using std::chrono::steady_clock;

// proc_stat(5): the columns after a core's name.
enum Column : std::size_t { kUser, kNice, kSystem, kIdle, kIoWait, kIrq, kSoftIrq, kSteal, kColumns };

bool is_niced() {
  return getpriority(PRIO_PROCESS, 0) > 0;
}

}  // namespace

std::vector<int> usable_cores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  std::vector<int> cores;
  if (sched_getaffinity(0, sizeof(set), &set) != 0) return cores;
  for (int core = 0; core < CPU_SETSIZE; ++core)
    if (CPU_ISSET(static_cast<std::size_t>(core), &set)) cores.push_back(core);
  return cores;
}

std::int64_t busy_ticks(std::string_view stat_text, const std::vector<int>& cores, bool with_niced) {
  std::istringstream lines{std::string(stat_text)};
  std::int64_t sum = 0;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name;
    words >> name;
    if (std::ranges::none_of(cores, [&](int core) { return name == "cpu" + std::to_string(core); })) continue;
    std::int64_t ticks = 0;
    for (std::size_t column = kUser; column < kColumns && words >> ticks; ++column)
      if (column != kIdle && column != kIoWait && (column != kNice || with_niced)) sum += ticks;
  }
  return sum;
}

int threads_worth_having(double free_cores, int now, int most) {
  // Half a core that is left and more is worth a helper, a quarter and less is not.
  const int up = static_cast<int>(std::floor(free_cores + 0.5)),
            down = static_cast<int>(std::floor(free_cores + 0.75));
  return std::clamp(std::clamp(now, up, down), 1, most);
}

FreeCores::FreeCores() : cores_(usable_cores()), last_(sample()), free_(static_cast<double>(cores_.size())) {}

FreeCores::Sample FreeCores::sample() const {
  const double ticks_per_s = static_cast<double>(std::max(1L, sysconf(_SC_CLK_TCK)));
  const auto busy = static_cast<double>(busy_ticks(file_text("/proc/stat"), cores_, is_niced()));
  return {steady_clock::now(), busy / ticks_per_s, process_cpu_seconds()};
}

double FreeCores::look() {
  if (steady_clock::now() - last_.time < kShortest) return free_;
  const Sample now = sample();
  const double seconds = std::chrono::duration<double>(now.time - last_.time).count();
  const double others = std::max(0.0, (now.busy_s - last_.busy_s) - (now.own_s - last_.own_s)) / seconds;
  last_ = now;
  free_ = std::max(0.0, static_cast<double>(cores_.size()) - others);
  return free_;
}

}  // namespace graspd

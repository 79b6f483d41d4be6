// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What this process takes of the machine.
#pragma once
#include <cstdint>
#include <string_view>

#include "service/runtime/clock.hpp"

namespace graspd {

struct ProcessUsage {
  double cpu = 0;  ///< processor time used since the last measurement, 1 = one core; 0 at the first
  std::int64_t rss_bytes = 0;  ///< resident now
  std::int64_t peak_rss_bytes = 0;
  int threads = 0;
  int descriptors = 0;  ///< open files and sockets
};

/// Processor time that this process has used so far, all threads and the kernel's for it [s].
[[nodiscard]] double process_cpu_seconds();

class ProcessUsageMeter {
 public:
  [[nodiscard]] ProcessUsage measure(Clock::TimePoint now);

 private:
  double last_cpu_s_ = 0;
  Clock::TimePoint last_time_{};
  bool started_ = false;
};

/// The bytes of a line like "VmRSS:  1234 kB" of /proc/self/status; 0 when it is not there.
[[nodiscard]] std::int64_t status_bytes(std::string_view status_text, std::string_view key);

/// The number of a line like "Threads:  9"; 0 when it is not there.
[[nodiscard]] std::int64_t status_number(std::string_view status_text, std::string_view key);

}  // namespace graspd

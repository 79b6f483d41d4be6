// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Other people's work on the same processor: programs that never sleep.
#pragma once
#include <sys/types.h>

#include <vector>

namespace graspd {

/// Processes that spin for as long as this lives, one on each of the first cores that this process may use.
class CpuHogs {
 public:
  /// Throws std::runtime_error when there are fewer cores than that, or a process cannot be started.
  explicit CpuHogs(int number);
  ~CpuHogs();
  CpuHogs(const CpuHogs&) = delete;
  CpuHogs& operator=(const CpuHogs&) = delete;

  /// Processor time that they have had so far, together [s].
  [[nodiscard]] double cpu_seconds() const;

 private:
  void end();

  std::vector<pid_t> pids_;
};

}  // namespace graspd

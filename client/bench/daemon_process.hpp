// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// A graspd that the benchmark starts, watches and ends.
#pragma once
#include <sys/types.h>

#include <string>
#include <vector>

namespace graspd {

/// Processor time of a running process so far [s].
[[nodiscard]] double process_cpu_seconds(pid_t pid);

class DaemonProcess {
 public:
  /// arguments: the program's path first. What it says is kept. Throws std::runtime_error when it cannot be
  /// started.
  explicit DaemonProcess(const std::vector<std::string>& arguments);
  ~DaemonProcess();
  DaemonProcess(const DaemonProcess&) = delete;
  DaemonProcess& operator=(const DaemonProcess&) = delete;

  [[nodiscard]] int pid() const { return pid_; }
  [[nodiscard]] bool running();
  /// Processor time so far [s].
  [[nodiscard]] double cpu_seconds() const { return process_cpu_seconds(pid_); }
  /// Largest resident memory so far [bytes].
  [[nodiscard]] double peak_bytes() const;
  /// What it wrote on standard error.
  [[nodiscard]] std::string said() const;

 private:
  pid_t pid_ = -1;
  int log_ = -1;
  bool ended_ = false;
};

/// The path of a program in the folder of this one.
[[nodiscard]] std::string program_beside(const std::string& name);

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/bench/cpu_hogs.hpp"

#include <sched.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string>

#include "client/bench/daemon_process.hpp"

namespace graspd {
namespace {

std::vector<int> usable_cores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  std::vector<int> cores;
  if (sched_getaffinity(0, sizeof(set), &set) != 0) return cores;
  for (int core = 0; core < CPU_SETSIZE; ++core)
    if (CPU_ISSET(static_cast<std::size_t>(core), &set)) cores.push_back(core);
  return cores;
}

/// In the child, which may be the copy of a process with many threads: system calls alone.
[[noreturn]] void spin_on(int core, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(static_cast<std::size_t>(core), &set);
  if (sched_setaffinity(0, sizeof(set), &set) != 0) _exit(1);
  for (volatile unsigned turns = 0;;) turns = turns + 1;
}

}  // namespace

CpuHogs::CpuHogs(int number) {
  const std::vector<int> cores = usable_cores();
  if (number > static_cast<int>(cores.size()))
    throw std::runtime_error("fewer cores than hogs (got " + std::to_string(number) + ", expected at most " +
                             std::to_string(cores.size()) + ")");
  const pid_t parent = getpid();
  for (std::size_t k = 0; k < static_cast<std::size_t>(number); ++k) {
    const pid_t pid = fork();
    if (pid == 0) spin_on(cores[k], parent);
    if (pid < 0) {
      const std::string reason = std::strerror(errno);
      end();
      throw std::runtime_error("no further process: " + reason);
    }
    pids_.push_back(pid);
  }
}

CpuHogs::~CpuHogs() {
  end();
}

void CpuHogs::end() {
  for (const pid_t pid : pids_) kill(pid, SIGKILL);
  for (const pid_t pid : pids_) waitpid(pid, nullptr, 0);
}

double CpuHogs::cpu_seconds() const {
  double sum = 0;
  for (const pid_t pid : pids_) sum += process_cpu_seconds(pid);
  return sum;
}

}  // namespace graspd

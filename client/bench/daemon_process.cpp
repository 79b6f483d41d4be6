// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/bench/daemon_process.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "client/bench/memory_use.hpp"

namespace graspd {
namespace {

constexpr std::chrono::seconds kPatience{5};

/// In the child: becomes the program, or ends with the code that shells use for what cannot be run.
[[noreturn]] void become(std::vector<char*>& arguments, int log) {
  const int nothing = open("/dev/null", O_RDWR);
  dup2(nothing, STDIN_FILENO);
  dup2(nothing, STDOUT_FILENO);
  dup2(log, STDERR_FILENO);
  close_range(STDERR_FILENO + 1, ~0U, 0);  // the benchmark's own sockets
  execv(arguments[0], arguments.data());
  _exit(127);
}

}  // namespace

DaemonProcess::DaemonProcess(const std::vector<std::string>& arguments) {
  std::vector<std::string> copies = arguments;
  std::vector<char*> pointers;
  pointers.reserve(copies.size() + 1);
  for (std::string& copy : copies) pointers.push_back(copy.data());
  pointers.push_back(nullptr);
  if (access(pointers[0], X_OK) != 0)
    throw std::runtime_error(arguments.front() + ": cannot be run: " + std::strerror(errno));
  log_ = memfd_create("graspd-log", MFD_CLOEXEC);
  pid_ = fork();
  if (pid_ == 0) become(pointers, log_);
  if (pid_ > 0) return;
  close(log_);
  throw std::runtime_error(std::string("no further process: ") + std::strerror(errno));
}

DaemonProcess::~DaemonProcess() {
  if (running()) kill(pid_, SIGTERM);
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (running() && std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  if (running()) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  close(log_);
}

bool DaemonProcess::running() {
  if (!ended_) ended_ = waitpid(pid_, nullptr, WNOHANG) != 0;
  return !ended_;
}

double process_cpu_seconds(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::string text;
  std::getline(file, text, ')');  // the name may hold spaces
  constexpr int kFieldsBefore = 11;
  for (int i = 0; i < kFieldsBefore; ++i) file >> text;
  double user = 0, system = 0;
  file >> user >> system;
  return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

double DaemonProcess::peak_bytes() const {
  return static_cast<double>(status_bytes(std::to_string(pid_), "VmHWM:").value_or(0));
}

std::string DaemonProcess::said() const {
  std::string text(4096, '\0');
  const ssize_t size = pread(log_, text.data(), text.size(), 0);
  text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  return text;
}

std::string program_beside(const std::string& name) {
  return (std::filesystem::read_symlink("/proc/self/exe").parent_path() / name).string();
}

}  // namespace graspd

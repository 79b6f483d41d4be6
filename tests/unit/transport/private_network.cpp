// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/transport/private_network.hpp"

#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <system_error>

namespace graspd {
namespace {

constexpr int kDenied = 10;
constexpr int kSetupFailed = 11;
constexpr int kThrew = 12;

/// Where only root may have a namespace, a user namespace makes one root inside it.
bool unshare_network() {
  if (unshare(CLONE_NEWNET) == 0) return true;
  const uid_t user = getuid();
  if (unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0) return false;
  std::ofstream map("/proc/self/uid_map");
  map << "0 " << user << " 1\n" << std::flush;
  return map.good();
}

int run_child(int output, const std::string& setup_command, const std::function<std::string()>& body) {
  if (!unshare_network()) return kDenied;
  if (std::system(setup_command.c_str()) != 0) return kSetupFailed;
  std::string text;
  int code = 0;
  try {
    text = body();
  } catch (const std::exception& error) {
    text = error.what();
    code = kThrew;
  }
  return write(output, text.data(), text.size()) == static_cast<ssize_t>(text.size()) ? code : kThrew;
}

std::string read_all(int fd) {
  std::string text;
  std::array<char, 4096> buffer{};
  for (ssize_t size = 0; (size = read(fd, buffer.data(), buffer.size())) > 0;) {
    text.append(buffer.data(), static_cast<std::size_t>(size));
  }
  return text;
}

}  // namespace

PrivateNetworkResult in_private_network(const std::string& setup_command,
                                        const std::function<std::string()>& body) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) throw std::system_error(errno, std::system_category(), "pipe");
  const pid_t child = fork();
  if (child < 0) throw std::system_error(errno, std::system_category(), "fork");
  if (child == 0) {
    close(ends[0]);
    _exit(run_child(ends[1], setup_command, body));
  }
  close(ends[1]);
  PrivateNetworkResult result;
  result.text = read_all(ends[0]);
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  result.denied = code == kDenied;
  if (code == kDenied) result.problem = "the kernel denies a network namespace (unshare)";
  if (code == kSetupFailed) result.problem = "failed: " + setup_command;
  if (code == kThrew) result.problem = "the body threw: " + result.text;
  if (!WIFEXITED(status)) result.problem = "the body died of signal " + std::to_string(WTERMSIG(status));
  if (result.problem.empty() && code != 0) result.problem = "exit code " + std::to_string(code);
  return result;
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/daemon/notifier.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "tests/unit/runtime/manual_clock.hpp"

namespace graspd {
namespace {

using namespace std::chrono_literals;

class NotifierTest : public testing::Test {
 protected:
  NotifierTest() { forget_environment(); }
  ~NotifierTest() override {
    forget_environment();
    if (fd_ >= 0) close(fd_);
    unlink(path_.c_str());
  }
  static void forget_environment() {
    for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"}) unsetenv(name);
  }

  /// What systemd would listen on.
  void listen_on(const std::string& name) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path, name.data(), name.size());
    if (name[0] == '@') address.sun_path[0] = '\0';
    fd_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
    ASSERT_EQ(bind(fd_, reinterpret_cast<const sockaddr*>(&address), length), 0) << strerror(errno);
    setenv("NOTIFY_SOCKET", name.c_str(), 1);
  }
  std::vector<std::string> received() {
    std::vector<std::string> messages;
    std::array<char, 4096> buffer{};
    for (ssize_t n = 0; (n = recv(fd_, buffer.data(), buffer.size(), 0)) > 0;)
      messages.emplace_back(buffer.data(), static_cast<std::size_t>(n));
    return messages;
  }

  const std::string path_ = testing::TempDir() + "graspd-notify-" + std::to_string(getpid());
  int fd_ = -1;
  ManualClock clock_;
};

TEST_F(NotifierTest, TellsEveryState) {
  listen_on(path_);
  Notifier notifier(clock_);
  notifier.starting(30s);
  notifier.ready();
  notifier.status("two\nlines");
  notifier.reloading();
  notifier.stopping();
  notifier.alive();
  const auto messages = received();
  ASSERT_EQ(messages.size(), 5u) << "no sign of life where none is asked for";
  EXPECT_EQ(messages[0], "EXTEND_TIMEOUT_USEC=30000000");
  EXPECT_EQ(messages[1], "READY=1");
  EXPECT_EQ(messages[2], "STATUS=two lines");
  EXPECT_EQ(messages[3].find("RELOADING=1\nMONOTONIC_USEC="), 0u) << messages[3];
  EXPECT_EQ(messages[4], "STOPPING=1");
}

TEST_F(NotifierTest, AbstractSockets) {
  listen_on("@graspd-notifier-test-" + std::to_string(getpid()));
  Notifier(clock_).ready();
  EXPECT_EQ(received(), std::vector<std::string>{"READY=1"});
}

TEST_F(NotifierTest, GivesThreeSignsOfLifeInTheWatchdogsTime) {
  listen_on(path_);
  setenv("WATCHDOG_USEC", "3000000", 1);
  setenv("WATCHDOG_PID", std::to_string(getpid()).c_str(), 1);
  Notifier notifier(clock_);
  for (int i = 0; i < 30; ++i) {
    notifier.alive();
    clock_.advance(100ms);
  }
  EXPECT_EQ(received(), (std::vector<std::string>{"WATCHDOG=1", "WATCHDOG=1", "WATCHDOG=1"}));
}

TEST_F(NotifierTest, AnotherProcessesWatchdogIsNotOurs) {
  listen_on(path_);
  setenv("WATCHDOG_USEC", "3000000", 1);
  setenv("WATCHDOG_PID", "1", 1);
  Notifier notifier(clock_);
  notifier.alive();
  EXPECT_TRUE(received().empty());
}

TEST_F(NotifierTest, NobodyListens) {
  Notifier(clock_).ready();
  setenv("NOTIFY_SOCKET", "/no/such/socket", 1);
  Notifier(clock_).ready();
  setenv("NOTIFY_SOCKET", (std::string("/") + std::string(200, 'x')).c_str(), 1);
  Notifier(clock_).ready();
  setenv("NOTIFY_SOCKET", "relative", 1);
  Notifier(clock_).ready();
}

}  // namespace
}  // namespace graspd

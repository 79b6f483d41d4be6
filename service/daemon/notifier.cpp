// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/daemon/notifier.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <ctime>

#include "service/transport/file_descriptor.hpp"

namespace graspd {
namespace {

std::int64_t number_in_environment(const char* name) {
  const char* text = std::getenv(name);
  if (text == nullptr) return 0;
  const std::string_view digits(text);
  std::int64_t value = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), value);
  return value;
}

std::int64_t monotonic_us() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return std::int64_t{time.tv_sec} * 1'000'000 + time.tv_nsec / 1000;
}

}  // namespace

Notifier::Notifier(const Clock& clock) : clock_(clock) {
  const char* path = std::getenv("NOTIFY_SOCKET");
  if (path != nullptr && (path[0] == '/' || path[0] == '@')) socket_ = path;
  const std::int64_t usec = number_in_environment("WATCHDOG_USEC");
  const std::int64_t pid = number_in_environment("WATCHDOG_PID");
  // Three signs of life in the time, so that a late one does no harm.
  if (usec > 0 && (pid == 0 || pid == getpid())) watchdog_ = std::chrono::microseconds(usec) / 3;
}

void Notifier::reloading() const {
  send("RELOADING=1\nMONOTONIC_USEC=" + std::to_string(monotonic_us()));
}

void Notifier::status(std::string_view text) const {
  std::string line(text);
  std::replace(line.begin(), line.end(), '\n', ' ');
  send("STATUS=" + line);
}

void Notifier::starting(std::chrono::seconds longer) const {
  send("EXTEND_TIMEOUT_USEC=" + std::to_string(std::chrono::microseconds(longer).count()));
}

void Notifier::alive() {
  if (watchdog_ == Clock::TimePoint::duration::zero() || clock_.now() < next_alive_) return;
  next_alive_ = clock_.now() + watchdog_;
  send("WATCHDOG=1");
}

void Notifier::send(std::string_view state) const {
  sockaddr_un address{};
  if (socket_.empty() || socket_.size() >= sizeof(address.sun_path)) return;
  address.sun_family = AF_UNIX;
  std::copy(socket_.begin(), socket_.end(), address.sun_path);
  if (socket_.front() == '@') address.sun_path[0] = '\0';  // a name that is no file
  const FileDescriptor fd(socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (fd.get() < 0) return;
  const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + socket_.size());
  // Lost when systemd does not take it: the next one tells the same.
  (void)sendto(fd.get(), state.data(), state.size(), MSG_NOSIGNAL,
               reinterpret_cast<const sockaddr*>(&address), length);
}

}  // namespace graspd

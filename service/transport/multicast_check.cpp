// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/multicast_check.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "service/transport/bus.hpp"
#include "service/transport/file_descriptor.hpp"
#include "service/transport/lcm_url.hpp"

namespace graspd {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kPatience{2000};
constexpr std::chrono::milliseconds kResend{100};
constexpr std::string_view kRouteRemedy =
    "ip link set lo up && ip route add 239.0.0.0/8 dev lo src 127.0.0.1";

/// A short LCM message: magic, sequence number, channel, payload.
constexpr std::string_view kSelfTest{"LC02\0\0\0\0LCM_SELF_TEST\0lcm self test", 35};

int datagram_socket() {
  return socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
}

[[noreturn]] void fail(const std::string& url, const std::string& reason, std::string_view remedy) {
  throw BusUnavailable("LCM URL '" + url + "': " + reason + "; remedy: " + std::string(remedy));
}

template <class Value>
bool set_option(int fd, int level, int option, const Value& value) {
  return setsockopt(fd, level, option, &value, sizeof(value)) == 0;
}

/// Receives like LCM does: any number of sockets share the port, the route chooses the interface. False: see
/// errno.
bool join(int fd, const sockaddr_in& group) {
  ip_mreq membership{};
  membership.imr_multiaddr = group.sin_addr;
  membership.imr_interface.s_addr = htonl(INADDR_ANY);
  sockaddr_in any = group;
  any.sin_addr.s_addr = htonl(INADDR_ANY);
  return fd >= 0 && set_option(fd, SOL_SOCKET, SO_REUSEADDR, int{1}) &&
         bind(fd, reinterpret_cast<const sockaddr*>(&any), sizeof(any)) == 0 &&
         set_option(fd, IPPROTO_IP, IP_ADD_MEMBERSHIP, membership) &&
         set_option(fd, IPPROTO_IP, IP_MULTICAST_TTL, std::uint8_t{0});
}

bool send_self_test(int fd, const sockaddr_in& group) {
  return sendto(fd, kSelfTest.data(), kSelfTest.size(), 0, reinterpret_cast<const sockaddr*>(&group),
                sizeof(group)) == static_cast<ssize_t>(kSelfTest.size());
}

/// The port that the kernel gave to a socket that has sent.
std::uint16_t local_port(int fd) {
  sockaddr_in address{};
  socklen_t length = sizeof(address);
  getsockname(fd, reinterpret_cast<sockaddr*>(&address), &length);
  return address.sin_port;
}

/// Waits a resend's time for the self-test that came from a port of ours; other traffic shows nothing about
/// multicast.
bool arrives(int fd, std::uint16_t from_port) {
  const auto deadline = Clock::now() + kResend;
  std::array<char, kSelfTest.size() + 1> buffer{};
  while (Clock::now() < deadline) {
    pollfd waiting{fd, POLLIN, 0};
    if (poll(&waiting, 1, static_cast<int>(kResend.count())) <= 0) continue;
    sockaddr_in from{};
    socklen_t length = sizeof(from);
    const ssize_t size =
        recvfrom(fd, buffer.data(), buffer.size(), MSG_DONTWAIT, reinterpret_cast<sockaddr*>(&from), &length);
    if (size == static_cast<ssize_t>(kSelfTest.size()) && from.sin_port == from_port &&
        std::memcmp(buffer.data(), kSelfTest.data(), kSelfTest.size()) == 0) {
      return true;
    }
  }
  return false;
}

}  // namespace

void require_multicast(const std::string& url) {
  const MulticastGroup group = multicast_group(url);
  const std::string name = group.address + ":" + std::to_string(group.port);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(group.port);
  inet_pton(AF_INET, group.address.c_str(), &address.sin_addr);

  const FileDescriptor receiver(datagram_socket());
  const FileDescriptor sender(datagram_socket());
  const auto error_text = [] { return std::system_category().message(errno); };
  if (receiver.get() < 0 || sender.get() < 0)
    fail(url, "no socket (" + error_text() + ")", "raise the limit of open files");
  const bool joined = join(receiver.get(), address);
  if (!joined && (errno == EADDRINUSE || errno == EACCES)) {
    fail(url, "port " + std::to_string(group.port) + " is taken (" + error_text() + ")",
         "choose another port in the URL");
  }
  if (!joined || !set_option(sender.get(), IPPROTO_IP, IP_MULTICAST_TTL, std::uint8_t{0}) ||
      !send_self_test(sender.get(), address)) {
    fail(url, "no multicast route to " + group.address + " (" + error_text() + ")", kRouteRemedy);
  }
  const auto deadline = Clock::now() + kPatience;
  while (!arrives(receiver.get(), local_port(sender.get()))) {
    if (Clock::now() >= deadline) {
      fail(url, "multicast to " + name + " does not come back to this machine",
           "let UDP port " + std::to_string(group.port) +
               " through the firewall, or route it to the loopback: " + std::string(kRouteRemedy));
    }
    (void)send_self_test(sender.get(), address);
  }
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// LcmBus against a tcpq server that misbehaves.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <memory>
#include <semaphore>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "service/transport/file_descriptor.hpp"
#include "service/transport/lcm_bus.hpp"
#include "tests/unit/transport/message_samples.hpp"

namespace graspd {
namespace {

using namespace std::chrono_literals;
constexpr auto kLong = std::chrono::milliseconds(1h);
constexpr std::int64_t kServerMagic = 0x287617fa;

/// A port of the loopback that takes connections, of which nobody ever hears.
class Listener {
 public:
  explicit Listener(int backlog) : fd_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    address_.sin_family = AF_INET;
    address_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t length = sizeof(address_);
    if (bind(fd_.get(), address(), length) != 0 || listen(fd_.get(), backlog) != 0 ||
        getsockname(fd_.get(), address(), &length) != 0) {
      throw std::runtime_error("no tcpq test server");
    }
  }
  [[nodiscard]] int get() const { return fd_.get(); }
  [[nodiscard]] sockaddr* address() { return reinterpret_cast<sockaddr*>(&address_); }
  [[nodiscard]] std::string url(const std::string& host) const {
    return "tcpq://" + host + ":" + std::to_string(ntohs(address_.sin_port));
  }

 private:
  FileDescriptor fd_;
  sockaddr_in address_{};
};

enum class Then { kHangUp, kStandStill };

/// Shakes hands with one client, sends it bytes after its first subscription, and hangs up, or does nothing
/// more until finish().
class OneShotServer {
 public:
  explicit OneShotServer(Bytes answer, Then then = Then::kHangUp)
      : thread_([this, answer = std::move(answer), then] { serve(answer, then); }) {}
  ~OneShotServer() { finish(); }
  void finish() {
    end_.release();
    if (thread_.joinable()) thread_.join();
  }
  [[nodiscard]] std::string url(const std::string& host) const { return listener_.url(host); }

 private:
  void serve(const Bytes& answer, Then then) {
    const int client = accept(listener_.get(), nullptr, nullptr);
    Bytes hello(8);
    put(hello, 0, kServerMagic, 4);
    put(hello, 4, 0x0100, 4);
    send(client, hello.data(), hello.size(), MSG_NOSIGNAL);
    std::array<char, 8 + 8 + 1> greeting_and_subscription{};  // to a channel of one letter
    recv(client, greeting_and_subscription.data(), greeting_and_subscription.size(), MSG_WAITALL);
    send(client, answer.data(), answer.size(), MSG_NOSIGNAL);
    if (then == Then::kStandStill) end_.acquire();
    shutdown(client, SHUT_WR);
    close(client);
  }

  const Listener listener_{1};
  std::counting_semaphore<> end_{0};
  std::thread thread_;
};

Bytes message_on_channel_a(const std::string& data) {
  Bytes bytes(4 + 4 + 1 + 4);
  put(bytes, 0, 1, 4);  // a publish
  put(bytes, 4, 1, 4);
  bytes[8] = std::byte{'A'};
  put(bytes, 9, static_cast<std::int64_t>(data.size()), 4);
  for (const char c : data) bytes.push_back(static_cast<std::byte>(c));
  return bytes;
}

TEST(TcpqBus, LostConnectionsCloseTheBusAndLeaveTheProcessAlive) {
  OneShotServer server(message_on_channel_a("hello"));
  LcmBus bus(server.url("localhost"));  // a name: LCM alone would not look it up
  std::string received;
  bus.subscribe("A", [&](const Packet& packet) {
    received.assign(reinterpret_cast<const char*>(packet.bytes.data()), packet.bytes.size());
  });
  EXPECT_EQ(bus.wait(kLong), LcmBus::Wait::kHandled);
  EXPECT_EQ(received, "hello");
  EXPECT_EQ(bus.wait(kLong), LcmBus::Wait::kClosed);
  EXPECT_EQ(bus.wait(kLong), LcmBus::Wait::kClosed);
  server.finish();
  EXPECT_FALSE(bus.publish("A", Bytes(10)));
  EXPECT_FALSE(bus.publish("A", Bytes(10)));
  EXPECT_EQ(bus.wait(kLong), LcmBus::Wait::kClosed);
  EXPECT_THROW(bus.subscribe("B", [](const Packet&) {}), std::runtime_error);
}

TEST(TcpqBus, ConnectionsLostInAMessageCloseTheBus) {
  Bytes part = message_on_channel_a("hello");
  part.pop_back();
  OneShotServer server(part);
  LcmBus bus(server.url("127.0.0.1"));
  bus.subscribe("A", [](const Packet&) { FAIL() << "half a message"; });
  EXPECT_EQ(bus.wait(kLong), LcmBus::Wait::kClosed);
}

TEST(TcpqBus, AServerThatStandsStillInAMessageClosesTheBus) {
  Bytes part = message_on_channel_a("hello");
  part.pop_back();
  const OneShotServer server(part, Then::kStandStill);
  LcmBus bus(server.url("127.0.0.1"));
  bus.subscribe("A", [](const Packet&) { FAIL() << "half a message"; });
  EXPECT_EQ(bus.wait(kLong), LcmBus::Wait::kClosed);
  bus.unsubscribe("A");  // and does not connect anew
  EXPECT_EQ(bus.wait(kLong), LcmBus::Wait::kClosed);
}

TEST(TcpqBus, AServerThatReadsNothingHoldsNobodyUp) {
  const OneShotServer server({}, Then::kStandStill);
  LcmBus bus(server.url("127.0.0.1"));
  bus.subscribe("A", [](const Packet&) {});
  const Bytes large(1 << 20);
  int sent = 0;
  while (sent < 1000 && bus.publish("A", large)) ++sent;
  EXPECT_LT(sent, 1000) << "nobody takes so much";
  EXPECT_EQ(bus.wait(kLong), LcmBus::Wait::kClosed);
}

/// Why it cannot be had for now.
std::string unavailable(const std::string& url) {
  try {
    LcmBus bus(url);
    return "it can";
  } catch (const BusUnavailable& error) {
    return error.what();
  }
}

TEST(TcpqBus, AServerThatNeverShakesHandsIsGivenUp) {
  const Listener listener(8);
  EXPECT_NE(unavailable(listener.url("127.0.0.1")).find("does not answer as a tcpq server does"),
            std::string::npos)
      << unavailable(listener.url("127.0.0.1"));
}

TEST(TcpqBus, AServerThatTakesNoMoreConnectionsIsGivenUp) {
  Listener listener(0);
  std::vector<std::unique_ptr<FileDescriptor>> waiting;
  for (int i = 0; i < 4; ++i) {  // more than its queue holds: the kernel answers no other
    const int fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    waiting.push_back(std::make_unique<FileDescriptor>(fd));
    (void)connect(fd, listener.address(), sizeof(sockaddr_in));
  }
  EXPECT_NE(unavailable(listener.url("127.0.0.1")).find("does not answer as a tcpq server does"),
            std::string::npos)
      << unavailable(listener.url("127.0.0.1"));
}

TEST(TcpqBus, RefusedConnectionsThrow) {
  const int reserved =
      socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);  // bound and not listening: nobody else's, refused
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t length = sizeof(address);
  ASSERT_EQ(bind(reserved, reinterpret_cast<sockaddr*>(&address), length), 0);
  ASSERT_EQ(getsockname(reserved, reinterpret_cast<sockaddr*>(&address), &length), 0);
  const std::string url = "tcpq://127.0.0.1:" + std::to_string(ntohs(address.sin_port));
  EXPECT_THROW(LcmBus bus(url), std::runtime_error);
  close(reserved);
}

TEST(TcpqBus, UnknownHostsThrow) {
  try {
    LcmBus bus("tcpq://no.such.host.invalid:7700");
    FAIL() << "no.such.host.invalid has an address";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("no address for host 'no.such.host.invalid'"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace graspd

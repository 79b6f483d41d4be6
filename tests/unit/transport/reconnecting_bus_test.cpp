// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/reconnecting_bus.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <string>
#include <thread>

#include "tests/unit/transport/message_samples.hpp"
#include "tests/unit/transport/private_network.hpp"

namespace graspd {
namespace {

using namespace std::chrono_literals;
using SteadyClock = std::chrono::steady_clock;

constexpr const char* kUdpm = "udpm://239.255.76.67:7667?ttl=0";
constexpr RetryTimes kQuick{1ms, 20ms,
                            60s};  // on a busy machine, too, silence is a loss only where it is meant
constexpr RetryTimes kQuickToNotice{1ms, 20ms, 100ms};

/// A bus, what it told, and what it received on A.
struct Watched {
  explicit Watched(const std::string& url, const RetryTimes& times = kQuick)
      : bus(url, times,
            {[this](const std::string& reason) {
               ++lost;
               why = reason;
             },
             [this] { ++restored; }}) {
    bus.subscribe("A", [this](const Packet&) { ++received; });
  }

  /// Waits and sends, until the condition holds; false when it never did.
  bool run_until(const std::function<bool()>& condition) {
    const auto deadline = SteadyClock::now() + 60s;
    while (!condition()) {
      if (SteadyClock::now() > deadline) return false;
      (void)bus.publish("A", Bytes(100));
      (void)bus.wait(5ms);
    }
    return true;
  }
  [[nodiscard]] std::string story() const {
    return "lost " + std::to_string(lost) + " restored " + std::to_string(restored) + " reconnects " +
           std::to_string(bus.reconnects()) + (bus.connected() ? " connected" : " away");
  }

  int lost = 0;
  int restored = 0;
  int received = 0;
  std::string why;
  ReconnectingBus bus;
};

bool run(const char* command) {
  return std::system(command) == 0;
}

TEST(ReconnectingBus, CarriesLikeAnyOther) {
  Watched watched("memq://");
  EXPECT_TRUE(watched.run_until([&] { return watched.received > 3; }));
  EXPECT_EQ(watched.story(), "lost 0 restored 0 reconnects 0 connected");
  watched.bus.unsubscribe("A");
  const int before = watched.received;
  EXPECT_TRUE(watched.bus.publish("A", Bytes(1)));
  EXPECT_EQ(watched.bus.wait(0ms), Bus::Wait::kTimeout);
  EXPECT_EQ(watched.received, before);
}

TEST(ReconnectingBus, UrlsThatCanNeverWorkThrow) {
  for (const char* url : {"udpm://10.0.0.1:7667", "nothing", "other://x", "file:///no/such/log"})
    EXPECT_THROW(ReconnectingBus(url, kQuick, {}), std::runtime_error) << url;
}

TEST(ReconnectingBus, TheEndOfALogIsAnEnd) {
  // An LCM event log of one event: sync word, number, time, lengths, channel, data.
  Bytes log(28);
  put(log, 0, 0xEDA1DA01, 4);
  put(log, 20, 1, 4);
  log.push_back(std::byte{'B'});
  const std::string path = testing::TempDir() + "reconnecting_bus_test.lcmlog";
  FILE* file = std::fopen(path.c_str(), "wb");
  ASSERT_NE(file, nullptr);
  ASSERT_EQ(std::fwrite(log.data(), 1, log.size(), file), log.size());
  ASSERT_EQ(std::fclose(file), 0);
  ReconnectingBus bus("file://" + path + "?speed=0", kQuick, {});
  Bus::Wait result = Bus::Wait::kTimeout;
  for (int i = 0; i < 1000 && result != Bus::Wait::kClosed; ++i) result = bus.wait(10ms);
  EXPECT_EQ(result, Bus::Wait::kClosed);
  std::remove(path.c_str());
}

TEST(ReconnectingBus, ComesUpWhenTheRouteDoes) {
  const auto result = in_private_network(kLoopback, [] {
    Watched watched(kUdpm);
    if (watched.bus.connected() || watched.bus.publish("A", Bytes(1)))
      return std::string("up without a route");
    for (int i = 0; i < 50; ++i) (void)watched.bus.wait(2ms);
    const std::string before = watched.story() + "; ";
    if (watched.why.find("ip route add 239.0.0.0/8 dev lo") == std::string::npos) return watched.why;
    if (!run("ip route add 239.0.0.0/8 dev lo")) return std::string("no route");
    if (!watched.run_until([&] { return watched.received > 0; })) return std::string("nothing received");
    return before + watched.story();
  });
  if (result.denied) GTEST_SKIP() << result.problem;
  ASSERT_EQ(result.problem, "");
  EXPECT_EQ(result.text, "lost 1 restored 0 reconnects 0 away; lost 1 restored 1 reconnects 1 connected");
}

TEST(ReconnectingBus, SurvivesTheLossOfTheRoute) {
  const auto result = in_private_network(kMulticast, [] {
    Watched watched(kUdpm);
    if (!watched.run_until([&] { return watched.received > 0; }))
      return std::string("nothing received at first");
    if (!run("ip route del 239.0.0.0/8 dev lo")) return std::string("no route");
    if (!watched.run_until([&] { return watched.lost > 0; })) return std::string("loss not noticed");
    const std::string before = watched.story() + "; ";
    if (!run("ip route add 239.0.0.0/8 dev lo")) return std::string("no route again");
    const int received = watched.received;
    if (!watched.run_until([&] { return watched.received > received; }))
      return std::string("nothing received");
    return before + watched.story();
  });
  if (result.denied) GTEST_SKIP() << result.problem;
  ASSERT_EQ(result.problem, "");
  EXPECT_EQ(result.text, "lost 1 restored 0 reconnects 0 away; lost 1 restored 1 reconnects 1 connected");
}

TEST(ReconnectingBus, NoticesThatItHearsNothingOfItsOwn) {
  // The route moves to another interface: sending works on, the old membership hears none of it.
  const auto result = in_private_network(kMulticast, [] {
    Watched watched(kUdpm, kQuickToNotice);
    if (!watched.run_until([&] { return watched.received > 0; }))
      return std::string("nothing received at first");
    if (!run(
            "ip link add d0 type veth peer name d1 && ip addr add 10.9.8.7/24 dev d0 && ip link set d0 up && "
            "ip link set d1 up && ip route replace 239.0.0.0/8 dev d0"))
      return std::string("skipped");
    if (!watched.run_until([&] { return watched.restored > 0; })) return watched.story();
    const int received = watched.received;
    if (!watched.run_until([&] { return watched.received > received; }))
      return std::string("nothing received");
    return watched.why;
  });
  if (result.denied) GTEST_SKIP() << result.problem;
  ASSERT_EQ(result.problem, "");
  if (result.text == "skipped") GTEST_SKIP() << "no second interface here";
  EXPECT_NE(result.text.find("its own messages are not heard"), std::string::npos) << result.text;
}

/// Accepts one client after the other, shakes hands, and hangs up on each after its first subscription, until
/// it has to end.
class RudeServer {
 public:
  RudeServer() : listener_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t length = sizeof(address);
    if (bind(listener_, reinterpret_cast<sockaddr*>(&address), length) != 0 || listen(listener_, 8) != 0 ||
        getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &length) != 0)
      throw std::runtime_error("no tcpq test server");
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] {
      while (serve()) {
      }
    });
  }
  ~RudeServer() {
    shutdown(listener_, SHUT_RDWR);
    thread_.join();
    close(listener_);
  }
  [[nodiscard]] std::string url() const { return "tcpq://127.0.0.1:" + std::to_string(port_); }

 private:
  [[nodiscard]] bool serve() const {
    const int client = accept(listener_, nullptr, nullptr);
    if (client < 0) return false;
    Bytes hello(8);
    put(hello, 0, 0x287617fa, 4);
    put(hello, 4, 0x0100, 4);
    send(client, hello.data(), hello.size(), MSG_NOSIGNAL);
    std::array<char, 8 + 8 + 1> greeting_and_subscription{};
    recv(client, greeting_and_subscription.data(), greeting_and_subscription.size(), MSG_WAITALL);
    close(client);
    return true;
  }

  int listener_;
  std::uint16_t port_ = 0;
  std::thread thread_;
};

TEST(ReconnectingBus, GoesBackToATcpqServerAsOftenAsItGoes) {
  std::signal(SIGPIPE, SIG_IGN);  // as the daemon does
  constexpr int kTimes = 5;
  auto server = std::make_unique<RudeServer>();
  Watched watched(server->url());
  const auto deadline = SteadyClock::now() + 60s;
  while (watched.lost < kTimes && SteadyClock::now() < deadline) {
    (void)watched.bus.publish("A", Bytes(100'000));
    (void)watched.bus.wait(1ms);
  }
  EXPECT_EQ(watched.lost, kTimes);
  EXPECT_EQ(watched.bus.reconnects(), kTimes - 1);
  server.reset();
  for (int i = 0; i < 50; ++i) EXPECT_EQ(watched.bus.wait(2ms), Bus::Wait::kTimeout);
  EXPECT_FALSE(watched.bus.connected());
  EXPECT_LE(watched.lost, kTimes + 1) << "told once a loss";
  EXPECT_NE(watched.why.find("lcm-tcpq-server"), std::string::npos) << watched.why;
}

TEST(ReconnectingBus, MayBePublishedOnWhileItIsMadeAnew) {
  std::signal(SIGPIPE, SIG_IGN);
  constexpr int kTimes = 20;
  auto server = std::make_unique<RudeServer>();
  Watched watched(server->url());
  std::atomic<bool> end = false;
  std::thread publisher([&] {
    while (!end) (void)watched.bus.publish("A", Bytes(1000));
  });
  const auto deadline = SteadyClock::now() + 60s;
  while (watched.lost < kTimes && SteadyClock::now() < deadline) (void)watched.bus.wait(1ms);
  end = true;
  publisher.join();
  server.reset();
  EXPECT_EQ(watched.lost, kTimes);
}

}  // namespace
}  // namespace graspd

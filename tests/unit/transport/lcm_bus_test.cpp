// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/lcm_bus.hpp"

#include <gtest/gtest.h>
#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "tests/unit/transport/message_samples.hpp"
#include "tests/unit/transport/private_network.hpp"

// LCM keeps the name of a channel that is not a regular expression. The linker finds the function by this
// name.
extern "C" const char* __lsan_default_suppressions();  // NOLINT(clang-diagnostic-reserved-identifier)
extern "C" const char* __lsan_default_suppressions() {
  return "leak:lcm_subscribe\n";
}  // NOLINT

namespace graspd {
namespace {

using namespace std::chrono_literals;
constexpr auto kLong = std::chrono::milliseconds(1h);  // a test that waits this long has failed

struct Received {
  std::string channel;
  Bytes bytes;
};

LcmBus::Handler store_in(std::vector<Received>& list) {
  return [&list](const Packet& packet) {
    list.push_back({std::string(packet.channel), Bytes(packet.bytes.begin(), packet.bytes.end())});
  };
}

Bytes payload(std::size_t size, int seed) {
  Random random(static_cast<Random::result_type>(seed));
  Bytes bytes(size);
  for (auto& byte : bytes) byte = static_cast<std::byte>(random());
  return bytes;
}

TEST(LcmBus, BytesArriveAsTheyWereSent) {
  LcmBus bus("memq://");
  std::vector<Received> received;
  bus.subscribe("A", store_in(received));
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{5'000'000}}) {
    ASSERT_TRUE(bus.publish("A", payload(size, 1)));
    ASSERT_EQ(bus.wait(kLong), LcmBus::Wait::kHandled);
    ASSERT_FALSE(received.empty());
    EXPECT_EQ(received.back().channel, "A");
    EXPECT_EQ(received.back().bytes, payload(size, 1));
  }
  EXPECT_EQ(bus.wait(0ms), LcmBus::Wait::kTimeout);
  EXPECT_EQ(bus.wait(-5ms), LcmBus::Wait::kTimeout);
}

TEST(LcmBus, ExpressionsMatchWholeNames) {
  LcmBus bus("memq://");
  std::vector<Received> received;
  bus.subscribe("CAM|DEPTH_.*", store_in(received));
  for (const char* channel : {"CAM_2", "XDEPTH_1", "DEPTH_1", "CAM", "A_CAM"}) bus.publish(channel, {});
  while (bus.wait(0ms) == LcmBus::Wait::kHandled) {
  }
  ASSERT_EQ(received.size(), 2u);
  EXPECT_EQ(received[0].channel, "DEPTH_1");
  EXPECT_EQ(received[1].channel, "CAM");
}

/// Waits until LCM's receiving thread has taken every datagram from the sockets of this network.
bool sockets_run_empty() {
  const auto deadline = std::chrono::steady_clock::now() + 60s;
  while (std::chrono::steady_clock::now() < deadline) {
    std::ifstream table("/proc/net/udp");
    std::string line;
    std::getline(table, line);
    bool empty = true;
    while (std::getline(table, line)) {
      std::istringstream words(line);
      std::string slot, local, remote, state, queues;  // transmit:receive
      words >> slot >> local >> remote >> state >> queues;
      empty = empty && queues.substr(queues.find(':') + 1) == "00000000";
    }
    if (empty) return true;
    std::this_thread::yield();
  }
  return false;
}

TEST(LcmBus, FullQueuesDropTheNewest) {
  const auto result = in_private_network(kMulticast, [] {
    const std::string url = "udpm://239.255.76.67:7667?ttl=0";
    LcmBus sender(url);
    LcmBus receiver(url);
    std::string received;
    receiver.subscribe(
        "[A-E]", [&](const Packet& packet) { received += packet.channel; }, 2);
    bool end = false;
    receiver.subscribe("END", [&](const Packet&) { end = true; });
    for (const char* channel : {"A", "B", "C", "D", "E", "END"}) sender.publish(channel, {});
    if (!sockets_run_empty()) return std::string("the sockets stay full");
    while (!end) receiver.wait(kLong);
    return received;
  });
  if (result.denied) GTEST_SKIP() << result.problem;
  EXPECT_EQ(result.problem, "");
  EXPECT_TRUE(result.text == "AB" || result.text == "ABC") << result.text;  // LCM 1.3.1 keeps one more
}

TEST(LcmBus, HandlersExceptionsComeOutOfWait) {
  LcmBus bus("memq://");
  int calls = 0;
  bus.subscribe("A", [&](const Packet&) {
    if (++calls == 1) throw std::out_of_range("first");
  });
  bus.subscribe("A", [&](const Packet&) { ++calls; });
  bus.publish("A", {});
  bus.publish("A", {});
  try {
    bus.wait(kLong);
    FAIL() << "nothing thrown";
  } catch (const std::out_of_range& error) {
    EXPECT_STREQ(error.what(), "first");
  }
  EXPECT_EQ(calls, 2);  // the other handler had its message
  EXPECT_EQ(bus.wait(kLong), LcmBus::Wait::kHandled);
  EXPECT_EQ(calls, 4);
}

/// Over UDP: memq hands messages from thread to thread under GLib's locks, which ThreadSanitizer does not
/// see.
std::string publish_from_threads() {
  constexpr int kThreads = 4;
  constexpr int kEach = 25;  // together less than the smallest receive buffer
  const std::string url = resolve_lcm_url("udpm://239.255.76.67:7667?ttl=0");
  LcmBus sender(url);
  LcmBus receiver(url);
  std::vector<Received> received;
  receiver.subscribe("T.*", store_in(received), kThreads * kEach);
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([&sender, channel = std::string("T").append(std::to_string(t))] {
      for (int i = 0; i < kEach; ++i) sender.publish(channel, payload(100, i));
    });
  }
  for (std::thread& thread : threads) thread.join();
  while (received.size() < static_cast<std::size_t>(kThreads * kEach)) receiver.wait(kLong);
  std::vector<int> next(kThreads, 0);
  for (const Received& message : received) {
    const auto t = static_cast<std::size_t>(message.channel[1] - '0');
    if (message.bytes != payload(100, next[t]++)) return message.channel + " is not in its order";
  }
  return "in order";
}

TEST(LcmBus, PublishesFromManyThreads) {
  const auto result = in_private_network(kMulticast, publish_from_threads);
  if (result.denied) GTEST_SKIP() << result.problem;
  EXPECT_EQ(result.problem, "");
  EXPECT_EQ(result.text, "in order");
}

TEST(LcmBus, SignalsCountAsTimeouts) {
  struct sigaction ignore {};
  struct sigaction before {};
  ignore.sa_handler = [](int) {};  // without SA_RESTART
  ASSERT_EQ(sigaction(SIGUSR1, &ignore, &before), 0);
  LcmBus bus("memq://");
  std::atomic<bool> done{false};
  const pthread_t waiting = pthread_self();
  std::thread sender([&] {
    while (!done) {
      pthread_kill(waiting, SIGUSR1);
      std::this_thread::yield();
    }
  });
  EXPECT_EQ(bus.wait(kLong), LcmBus::Wait::kTimeout);
  done = true;
  sender.join();
  sigaction(SIGUSR1, &before, nullptr);
}

TEST(LcmBus, RefusesWhatLcmCannotSend) {
  LcmBus bus("memq://");
  EXPECT_TRUE(bus.publish(std::string(63, 'A'), {}));
  EXPECT_FALSE(bus.publish(std::string(64, 'A'), {}));
  EXPECT_FALSE(bus.publish("A", Bytes((std::size_t{1} << 28) + 1)));
}

TEST(LcmBus, BadUrlsAndChannelsThrowWithReasonAndRemedy) {
  const auto error = [](const std::string& url) -> std::string {
    try {
      LcmBus bus(url);
      bus.subscribe("(", [](const Packet&) {});
      return "";
    } catch (const std::runtime_error& e) {
      return e.what();
    }
  };
  EXPECT_EQ(error("nonsense").rfind("LCM URL 'nonsense': no LCM URL (expected", 0), 0u) << error("nonsense");
  EXPECT_NE(error("bogus://").find("unknown provider 'bogus' (expected udpm, tcpq, file or memq)"),
            std::string::npos);
  EXPECT_NE(error("file:///no/such/log").find("cannot open the log '/no/such/log'; remedy"),
            std::string::npos);
  EXPECT_NE(error("udpm://10.0.0.1").find("no multicast group"), std::string::npos);
  EXPECT_NE(error("memq://").find("LCM channel '(': not a regular expression"), std::string::npos)
      << error("memq://");
}

TEST(LcmBus, LogsAreWrittenAndReadToTheirEnd) {
  const auto path =
      std::filesystem::temp_directory_path() / ("graspd_bus_" + std::to_string(getpid()) + ".log");
  {
    LcmBus writer("file://" + path.string() + "?mode=w");
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(writer.publish("A", payload(1000, i)));
  }
  LcmBus reader("file://" + path.string() + "?speed=0");
  std::vector<Received> received;
  reader.subscribe("A", store_in(received));
  for (int i = 0; i < 3; ++i) ASSERT_EQ(reader.wait(kLong), LcmBus::Wait::kHandled);
  EXPECT_EQ(reader.wait(kLong), LcmBus::Wait::kClosed);
  EXPECT_EQ(reader.wait(kLong), LcmBus::Wait::kClosed);
  EXPECT_FALSE(reader.publish("A", {}));
  ASSERT_EQ(received.size(), 3u);
  EXPECT_EQ(received[2].bytes, payload(1000, 2));
  std::filesystem::remove(path);
}

TEST(LcmBus, CarriesBytesOverUdp) {
  const auto result = in_private_network(kMulticast, [] {
    const std::string url = resolve_lcm_url("udpm://239.255.76.67:7667?ttl=0");
    LcmBus sender(url);
    LcmBus receiver(url);
    std::vector<Received> received;
    receiver.subscribe("A", store_in(received));
    const Bytes sent = payload(150'000, 3);  // three fragments
    if (!sender.publish("A", sent)) return std::string("not sent");
    while (received.empty()) {
      if (receiver.wait(kLong) != LcmBus::Wait::kHandled) return std::string("not received");
    }
    return std::string(received[0].bytes == sent ? "the same" : "changed");
  });
  if (result.denied) GTEST_SKIP() << result.problem;
  EXPECT_EQ(result.problem, "");
  EXPECT_EQ(result.text, "the same");
}

}  // namespace
}  // namespace graspd

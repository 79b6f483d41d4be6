// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// A bus that comes back: when LCM cannot be had at the start, when a tcpq server goes, when a network is
// lost.
#pragma once
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <shared_mutex>
#include <string>
#include <vector>

#include "service/transport/lcm_bus.hpp"

namespace graspd {

struct RetryTimes {
  std::chrono::milliseconds first{
      100};  ///< pause before the second attempt; each further one is twice as long
  std::chrono::milliseconds longest{5000};  ///< up to this
  /// A udpm bus that hears nothing for so long, its owner's own messages among it, is made anew.
  std::chrono::milliseconds silence{5000};
};

/// Keeps its subscriptions over every loss. publish() gives false while the bus is away; wait() tries to get
/// it back. A udpm bus is taken for lost when a message cannot be sent, or when nothing arrives although
/// messages are sent on a channel that is subscribed to: the owner has to subscribe to one that it sends on.
class ReconnectingBus final : public Bus {
 public:
  struct Events {
    std::function<void(const std::string& reason)> lost;  ///< once a loss, with the remedy
    std::function<void()> restored;                       ///< also when the first attempt was in vain
  };

  /// Makes the first attempt. Throws std::runtime_error where no attempt can succeed.
  ReconnectingBus(std::string url, const RetryTimes& times, Events events);
  ~ReconnectingBus() override;

  using Bus::subscribe;
  void subscribe(const std::string& channel_regex, Handler handler, int queue_capacity) override;
  void unsubscribe(const std::string& channel_regex) override;
  /// kClosed at the end of a log file alone.
  Wait wait(std::chrono::milliseconds timeout) override;
  bool publish(const std::string& channel, std::span<const std::byte> bytes) override;

  [[nodiscard]] bool connected() const override { return connected_; }
  [[nodiscard]] std::int64_t reconnects() const override { return reconnects_; }

 private:
  using SteadyClock = std::chrono::steady_clock;
  struct Subscription {
    std::string channel_regex;
    Handler handler;
    int queue_capacity;
  };

  void connect();
  void lose(const std::string& reason);
  void replace(std::unique_ptr<LcmBus> bus);
  [[nodiscard]] Wait wait_away(std::chrono::milliseconds timeout);
  void look_after_network();

  const std::string url_;
  const std::string provider_;
  const RetryTimes times_;
  const Events events_;
  std::vector<Subscription> subscriptions_;
  mutable std::shared_mutex mutex_;  // shared: publishing; alone: replacing the bus
  std::unique_ptr<LcmBus> bus_;
  std::atomic<bool> connected_ = false;
  std::atomic<bool> send_failed_ = false;
  std::atomic<int> sent_unheard_ = 0;
  std::atomic<std::int64_t> reconnects_ = 0;
  std::chrono::milliseconds pause_;
  SteadyClock::time_point next_attempt_;
  SteadyClock::time_point last_heard_;
  bool told_ = false;  // of the loss
};

}  // namespace graspd

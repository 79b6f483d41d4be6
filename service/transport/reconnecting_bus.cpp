// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/reconnecting_bus.hpp"

#include <algorithm>
#include <mutex>
#include <thread>
#include <utility>

namespace graspd {
namespace {

// Of the owner's messages fewer may simply be under way.
constexpr int kFewestUnheard = 3;

}  // namespace

ReconnectingBus::ReconnectingBus(std::string url, const RetryTimes& times, Events events)
    : url_(std::move(url)),
      provider_(parse_lcm_url(url_).provider),
      times_(times),
      events_(std::move(events)),
      pause_(times.first),
      next_attempt_(SteadyClock::now()) {
  connect();
}

ReconnectingBus::~ReconnectingBus() = default;

void ReconnectingBus::subscribe(const std::string& channel_regex, Handler handler, int queue_capacity) {
  subscriptions_.push_back({channel_regex, handler, queue_capacity});
  if (!bus_) return;
  try {
    bus_->subscribe(channel_regex, std::move(handler), queue_capacity);
  } catch (const BusUnavailable& error) {
    lose(error.what());
  } catch (...) {
    subscriptions_.pop_back();
    throw;
  }
}

void ReconnectingBus::unsubscribe(const std::string& channel_regex) {
  if (bus_) bus_->unsubscribe(channel_regex);
  std::erase_if(subscriptions_, [&](const Subscription& s) { return s.channel_regex == channel_regex; });
}

Bus::Wait ReconnectingBus::wait(std::chrono::milliseconds timeout) {
  if (!bus_) return wait_away(timeout);
  const Wait result = bus_->wait(timeout);
  if (result == Wait::kHandled) {
    last_heard_ = SteadyClock::now();
    sent_unheard_ = 0;
  }
  if (result == Wait::kClosed && provider_ == "tcpq") {
    lose("LCM URL '" + url_ +
         "': the connection was closed or stood still; remedy: look after lcm-tcpq-server there");
    return Wait::kTimeout;
  }
  if (provider_ == "udpm") look_after_network();
  return result;
}

bool ReconnectingBus::publish(const std::string& channel, std::span<const std::byte> bytes) {
  const std::shared_lock lock(mutex_);
  if (!bus_ || !LcmBus::can_carry(channel, bytes)) return false;
  const bool sent = bus_->publish(channel, bytes);
  if (sent) {
    ++sent_unheard_;
  } else {
    send_failed_ = true;
  }
  return sent;
}

Bus::Wait ReconnectingBus::wait_away(std::chrono::milliseconds timeout) {
  const auto now = SteadyClock::now();
  if (now < next_attempt_) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(next_attempt_ - now);
    std::this_thread::sleep_for(std::clamp(left, std::chrono::milliseconds(0), timeout));
  } else {
    connect();
  }
  return Wait::kTimeout;
}

void ReconnectingBus::look_after_network() {
  const bool silent = sent_unheard_ >= kFewestUnheard && SteadyClock::now() - last_heard_ >= times_.silence;
  if (send_failed_) {
    lose("LCM URL '" + url_ +
         "': a message could not be sent; remedy: check the network and its multicast route");
  } else if (silent) {
    lose("LCM URL '" + url_ + "': its own messages are not heard; remedy: check the multicast route");
  }
}

void ReconnectingBus::connect() {
  try {
    auto bus = std::make_unique<LcmBus>(url_);
    for (const Subscription& s : subscriptions_) bus->subscribe(s.channel_regex, s.handler, s.queue_capacity);
    replace(std::move(bus));
  } catch (const BusUnavailable& error) {
    lose(error.what());
  }
}

void ReconnectingBus::replace(std::unique_ptr<LcmBus> bus) {
  {
    const std::unique_lock lock(mutex_);
    bus_ = std::move(bus);
    send_failed_ = false;
    sent_unheard_ = 0;
  }
  last_heard_ = SteadyClock::now();
  pause_ = times_.first;
  connected_ = true;
  if (!std::exchange(told_, false)) return;
  ++reconnects_;
  if (events_.restored) events_.restored();
}

void ReconnectingBus::lose(const std::string& reason) {
  std::unique_ptr<LcmBus> old;  // its threads end outside of the lock
  {
    const std::unique_lock lock(mutex_);
    old = std::move(bus_);
  }
  connected_ = false;
  next_attempt_ = SteadyClock::now() + pause_;
  pause_ = std::min(2 * pause_, times_.longest);
  if (std::exchange(told_, true)) return;
  if (events_.lost) events_.lost(reason);
}

}  // namespace graspd

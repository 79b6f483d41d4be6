// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Bytes in, bytes out: what the daemon needs of a network.
#pragma once
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace graspd {

/// A message as it arrived. The views hold during the handler alone.
struct Packet {
  std::string_view channel;
  std::span<const std::byte> bytes;
  std::int64_t recv_utime = 0;  ///< [us] since 1970
};

/// The network is not there now and may be later. what() names the URL, the reason and the remedy.
class BusUnavailable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// subscribe(), unsubscribe() and wait() belong to one thread; publish() may be called from any.
class Bus {
 public:
  /// kClosed: a log file's end, or a connection that is gone for good.
  enum class Wait { kHandled, kTimeout, kClosed };
  using Handler = std::function<void(const Packet&)>;
  static constexpr int kDefaultQueue = 30;

  Bus() = default;
  virtual ~Bus() = default;
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  /// The regular expression is matched against whole channel names. When queue_capacity messages wait (one
  /// more in LCM 1.3.1; memq and tcpq have no limit), the newest is dropped. Throws std::runtime_error. Not
  /// from within a handler.
  virtual void subscribe(const std::string& channel_regex, Handler handler, int queue_capacity) = 0;
  void subscribe(const std::string& channel_regex, Handler handler) {
    subscribe(channel_regex, std::move(handler), kDefaultQueue);
  }

  /// Ends all subscriptions to just this expression. Not from within a handler.
  virtual void unsubscribe(const std::string& channel_regex) = 0;

  /// Waits for one message and calls its handlers; rethrows what a handler throws. A signal counts as a
  /// timeout.
  virtual Wait wait(std::chrono::milliseconds timeout) = 0;

  /// False when it could not be sent: too large, a channel name of more than 63 characters, no way out.
  virtual bool publish(const std::string& channel, std::span<const std::byte> bytes) = 0;

  /// From any thread: whether messages can be sent now, as far as is known.
  [[nodiscard]] virtual bool connected() const { return true; }
  /// How often it was made anew after a loss.
  [[nodiscard]] virtual std::int64_t reconnects() const { return 0; }
};

}  // namespace graspd

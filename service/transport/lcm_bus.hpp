// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// LCM's C API as a C++ object: bytes in, bytes out.
#pragma once
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "service/transport/lcm_url.hpp"

struct _lcm_t;  // NOLINT(bugprone-reserved-identifier): the name that liblcm gives it

namespace graspd {

/// A message as it arrived. The views hold during the handler alone.
struct Packet {
  std::string_view channel;
  std::span<const std::byte> bytes;
  std::int64_t recv_utime = 0;  ///< [us] since 1970
};

/// subscribe() and wait() belong to one thread; publish() may be called from any.
class LcmBus {
 public:
  /// kClosed: a log file's end, or a tcpq server that is gone. There is no way back but a new bus.
  enum class Wait { kHandled, kTimeout, kClosed };
  using Handler = std::function<void(const Packet&)>;

  /// Throws std::runtime_error whose text names the URL, the reason and the remedy. udpm: takes some
  /// milliseconds to see whether multicast gets through, two seconds where it does not (LCM alone would take
  /// ten).
  explicit LcmBus(const std::string& url);
  ~LcmBus();
  LcmBus(const LcmBus&) = delete;
  LcmBus& operator=(const LcmBus&) = delete;

  /// The regular expression is matched against whole channel names. When queue_capacity messages wait (one
  /// more in LCM 1.3.1; memq and tcpq have no limit), the newest is dropped. Throws std::runtime_error. Not
  /// from within a handler.
  void subscribe(const std::string& channel_regex, Handler handler, int queue_capacity = 30);

  /// Waits for one message and calls its handlers; rethrows what a handler throws. A signal counts as a
  /// timeout.
  Wait wait(std::chrono::milliseconds timeout);

  /// False when LCM could not send it: too large, a channel name of more than 63 characters, no way out.
  bool publish(const std::string& channel, std::span<const std::byte> bytes);

 private:
  struct Subscription;
  void require_receiving();

  const std::string url_;
  const std::string provider_;
  std::vector<std::unique_ptr<Subscription>> subscriptions_;  // LCM keeps their addresses
  std::unique_ptr<_lcm_t, void (*)(_lcm_t*)> lcm_;            // goes before the subscriptions
  std::mutex publish_mutex_;
  std::exception_ptr handler_error_;
};

}  // namespace graspd

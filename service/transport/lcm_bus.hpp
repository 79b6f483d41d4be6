// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// LCM's C API as a C++ object.
#pragma once
#include <chrono>
#include <cstddef>
#include <exception>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "service/transport/bus.hpp"
#include "service/transport/lcm_url.hpp"

struct _lcm_t;  // NOLINT(clang-diagnostic-reserved-identifier): the name that liblcm gives it

namespace graspd {

/// A bus that closes when its connection is lost, or a tcpq server stands still in a message for a second:
/// there is no way back but a new one.
class LcmBus final : public Bus {
 public:
  /// Throws std::runtime_error whose text names the URL, the reason and the remedy; BusUnavailable where
  /// another attempt may succeed. udpm: takes some milliseconds to see whether multicast gets through, two
  /// seconds where it does not (LCM alone would take ten). tcpq: a second at most, besides the look-up of a
  /// name.
  explicit LcmBus(const std::string& url);
  ~LcmBus() override;

  using Bus::subscribe;
  void subscribe(const std::string& channel_regex, Handler handler, int queue_capacity) override;
  void unsubscribe(const std::string& channel_regex) override;
  Wait wait(std::chrono::milliseconds timeout) override;
  bool publish(const std::string& channel, std::span<const std::byte> bytes) override;

  /// Whether LCM can send such a message at all.
  [[nodiscard]] static bool can_carry(const std::string& channel, std::span<const std::byte> bytes);

 private:
  struct Subscription;
  void require_receiving();
  /// Whether it was done in time.
  [[nodiscard]] bool create(const std::string& url);
  /// Of a tcpq connection: reader and writers close its socket.
  [[nodiscard]] std::unique_lock<std::recursive_mutex> lock_connection();
  int handle();

  const std::string url_;
  const std::string provider_;
  std::vector<std::unique_ptr<Subscription>> subscriptions_;  // LCM keeps their addresses
  std::unique_ptr<_lcm_t, void (*)(_lcm_t*)> lcm_;            // goes before the subscriptions
  std::recursive_mutex use_mutex_;                            // handlers publish, too
  std::exception_ptr handler_error_;
};

}  // namespace graspd

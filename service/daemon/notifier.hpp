// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Tells systemd how the daemon is: sd_notify(3)'s datagrams.
#pragma once
#include <string>
#include <string_view>

#include "service/runtime/clock.hpp"

namespace graspd {

/// Written here rather than linked: libsystemd brings four compression libraries and a cipher along for one
/// datagram, whose form is documented as stable. Without NOTIFY_SOCKET in the environment all of it does
/// nothing.
class Notifier {
 public:
  /// Reads NOTIFY_SOCKET, WATCHDOG_USEC and WATCHDOG_PID.
  explicit Notifier(const Clock& clock);

  void ready() const { send("READY=1"); }
  void stopping() const { send("STOPPING=1"); }
  /// To be followed by ready().
  void reloading() const;
  /// One line for people, shown by `systemctl status`.
  void status(std::string_view text) const;
  /// The start is not over in the usual time and goes on for so long at least.
  void starting(std::chrono::seconds longer) const;
  /// Feeds the watchdog, as often as it wants; when this is not called systemd ends the process.
  void alive();

 private:
  void send(std::string_view state) const;

  const Clock& clock_;
  std::string socket_;
  Clock::TimePoint::duration watchdog_{};  // between two signs of life; zero: no watchdog
  Clock::TimePoint next_alive_{};
};

}  // namespace graspd

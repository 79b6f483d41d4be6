// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What a web server counts.
#pragma once
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace graspd {

enum class WebEvent : std::uint8_t {
  kConnection,      ///< TCP connections that came
  kFile,            ///< files served
  kClient,          ///< WebSockets opened
  kMessageIn,       ///< messages taken from clients
  kMessageOut,      ///< messages written to clients
  kBytesOut,        ///< their bytes
  kReplaced,        ///< messages that a newer one of their topic took the place of, before a client took them
  kNotFound,        ///< refused: no such file
  kBadRequest,      ///< refused: no HTTP, or larger than a request may be
  kBadMethod,       ///< refused: neither GET nor HEAD
  kBadPath,         ///< refused: a path that climbs, or has bytes that no path needs
  kForeignHost,     ///< refused: asked by a name that is not ours
  kForeignOrigin,   ///< refused: a page of another origin
  kBadToken,        ///< refused: the token is missing or wrong
  kTooMany,         ///< refused: more connections or clients than allowed
  kHugeMessage,     ///< closed: a message larger than allowed
  kFlood,           ///< closed: more messages a second than allowed
  kOverflow,        ///< closed: does not take what must not be lost
  kRefusedMessage,  ///< messages that the program behind the server refused
};
inline constexpr std::size_t kNumWebEvents = static_cast<std::size_t>(WebEvent::kRefusedMessage) + 1;

/// lower_snake.
[[nodiscard]] std::string_view name(WebEvent event);

/// For any thread.
class WebCounters {
 public:
  void add(WebEvent event, std::int64_t count = 1) {
    counts_[static_cast<std::size_t>(event)].fetch_add(count, std::memory_order_relaxed);
  }
  [[nodiscard]] std::int64_t get(WebEvent event) const {
    return counts_[static_cast<std::size_t>(event)].load(std::memory_order_relaxed);
  }

 private:
  std::array<std::atomic<std::int64_t>, kNumWebEvents> counts_{};
};

}  // namespace graspd

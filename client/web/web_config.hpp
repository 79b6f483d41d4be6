// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Where a web server listens, what it serves and what it takes from strangers.
#pragma once
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace graspd {

struct WebConfig {
  std::string address = "127.0.0.1";  ///< to listen on; with any but a loopback address a token must be given
  std::uint16_t port = 0;             ///< 0: a free one
  /// What write access needs, and on other than loopback addresses every WebSocket. Empty: drawn at the
  /// start.
  std::string token;
  std::filesystem::path assets;         ///< folder whose files are served; empty: none
  std::string socket_path = "/socket";  ///< where WebSockets are opened
  std::string subprotocol;              ///< that clients may ask for; empty: none
  std::vector<std::string> origins;     ///< of pages that may connect besides our own, as https://example.org

  std::size_t max_request_bytes = 8192;     ///< of a request's line and headers
  std::size_t max_message_bytes = 65'536;   ///< from a client
  std::size_t max_waiting_bytes = 1 << 20;  ///< that must not be lost, for a client that does not take them
  int max_connections = 64;
  int max_messages_per_s = 100;              ///< from one client, on average over a second
  std::chrono::seconds request_timeout{10};  ///< for a whole request
  std::chrono::seconds silence_timeout{30};  ///< clients that do not even answer a ping are given up
};

}  // namespace graspd

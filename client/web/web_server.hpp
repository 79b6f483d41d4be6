// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// A small HTTP and WebSocket server for pages that show what goes on: static files, messages to and from
// clients.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "client/web/outbox.hpp"
#include "client/web/web_config.hpp"
#include "client/web/web_counters.hpp"

namespace graspd {

/// One open WebSocket.
struct WebClient {
  std::int64_t id = 0;
  bool may_write = false;  ///< showed the token
};

/// Called on the server's thread, one at a time; they must not wait, and must not throw.
struct WebHandlers {
  std::function<void(const WebClient&)> opened;
  /// What a client sent, no more than max_message_bytes; nothing in it can be trusted.
  std::function<void(const WebClient&, std::string_view message, bool is_text)> received;
  std::function<void(const WebClient&)> closed;
};

/// Serves on a thread of its own from start() to its end. Every function may be called from any thread.
class WebServer {
 public:
  /// Listens. Throws std::runtime_error when it cannot listen there, an address beyond this machine comes
  /// without a token, or the assets cannot be read.
  WebServer(WebConfig config, WebHandlers handlers);
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  /// Begins to answer; once. Handlers are called from here on.
  void start();

  [[nodiscard]] std::uint16_t port() const;
  [[nodiscard]] const std::string& token() const;
  /// http://127.0.0.1:8090/
  [[nodiscard]] std::string url() const;

  /// Of a topic (any number) only the newest message waits for a client: one that is slow gets fewer of them.
  void send_latest(std::int64_t client, int topic, WebMessage message);
  void broadcast_latest(int topic, const WebMessage& message);
  /// Comes in order and is not left out; a client with no room for it is closed.
  void send(std::int64_t client, WebMessage message);
  void broadcast(const WebMessage& message);

  [[nodiscard]] int clients() const;
  [[nodiscard]] WebCounters& counters();
  [[nodiscard]] const WebCounters& counters() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace graspd

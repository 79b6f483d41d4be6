// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Handle lists and statuses out to WebSockets, control messages and clouds in from those that show the token.
#pragma once
#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "client/web/web_server.hpp"
#include "service/transport/bus.hpp"
#include "service/transport/sealer.hpp"

namespace graspd {

struct BridgeChannels {
  std::string handles = "GRASPD_HANDLES";  ///< or a regular expression for the whole name
  std::string status = "GRASPD_STATUS";    ///< the same
  std::string control = "GRASPD_CONTROL";  ///< empty: no control messages are taken
  std::string clouds;                      ///< empty: no clouds are taken
};

/// One server. The bus must live longer; messages come in by the bus's thread, commands by the web server's.
class Bridge {
 public:
  /// latest_only: a client that is too slow misses handle lists; else it gets all of them in their order, or
  /// is closed. key_file: to seal with what is sent; empty: nothing is sealed. Throws std::runtime_error.
  Bridge(Bus& bus, BridgeChannels channels, WebConfig web, bool latest_only, const std::string& key_file);

  /// Subscribes, and lets clients in.
  void start();

  [[nodiscard]] WebServer& web() { return web_; }
  [[nodiscard]] std::int64_t invalid() const { return invalid_; }  ///< messages from the bus

 private:
  WebHandlers handlers();
  void handle_list_came(const Packet& packet);
  void status_came(const Packet& packet);
  void received(const WebClient& client, std::string_view message, bool is_text);
  std::string take_control(std::string_view text);
  std::optional<std::string> take_cloud(std::string_view bytes);
  bool publish(const std::string& channel, std::span<const std::byte> message);

  Bus& bus_;
  const BridgeChannels channels_;
  const bool latest_only_;
  std::optional<Sealer> sealer_;  // of the web server's thread
  std::int64_t last_id_ = 0;      // the same
  std::int64_t invalid_ = 0;
  WebServer web_;  // goes first: its thread uses the rest
};

}  // namespace graspd

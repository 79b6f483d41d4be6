// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The open WebSockets of a server, and what all of its connections share.
#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "client/web/access.hpp"
#include "client/web/assets.hpp"
#include "client/web/web_server.hpp"

namespace graspd {

/// One open WebSocket, as the hub sees it. For any thread.
class WebPeer {
 public:
  virtual ~WebPeer() = default;
  virtual void put_latest(int topic, const WebMessage& message) = 0;
  virtual void put(const WebMessage& message) = 0;
};

/// Lives longer than every connection.
struct WebHub {
  WebHub(WebConfig config_in, WebHandlers handlers_in);

  /// Puts a peer among those that get messages. shared_ptr: a peer lives as long as the network or a sender
  /// uses it.
  void add(std::int64_t id, const std::shared_ptr<WebPeer>& peer);
  void remove(std::int64_t id);
  void clear();
  void for_each(const std::function<void(WebPeer&)>& action);
  void with(std::int64_t id, const std::function<void(WebPeer&)>& action);
  [[nodiscard]] int size() const;

  const WebConfig config;
  const WebHandlers handlers;
  const AccessRules rules;
  const Assets assets;
  WebCounters counters;
  int connections = 0;       // of the server's thread alone
  std::int64_t next_id = 1;  // the same

 private:
  mutable std::mutex mutex_;
  std::map<std::int64_t, std::shared_ptr<WebPeer>> peers_;
};

}  // namespace graspd

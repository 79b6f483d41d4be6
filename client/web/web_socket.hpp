// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// One WebSocket from its handshake to its end.
#pragma once
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <chrono>
#include <memory>
#include <mutex>

#include "client/web/hub.hpp"

namespace graspd {

/// Shared: each operation that the network works on holds it alive.
class WebSocket final : public WebPeer, public std::enable_shared_from_this<WebSocket> {
 public:
  using Upgrade = boost::beast::http::request<boost::beast::http::empty_body>;

  WebSocket(boost::beast::tcp_stream stream, WebHub& hub, bool may_write);
  ~WebSocket() override;

  void accept(Upgrade request);

  void put_latest(int topic, const WebMessage& message) override;
  void put(const WebMessage& message) override;

 private:
  void opened(const boost::system::error_code& error);
  void read_next();
  void received(const boost::system::error_code& error);
  [[nodiscard]] bool floods();
  void wake();
  void write_next();
  void close(boost::beast::websocket::close_code code);
  void ended();

  boost::beast::websocket::stream<boost::beast::tcp_stream> stream_;
  WebHub& hub_;
  WebClient client_;
  Upgrade request_;
  boost::beast::flat_buffer buffer_;
  bool open_ = false;
  bool writing_ = false;
  double tokens_;  // messages that may come at once
  std::chrono::steady_clock::time_point last_message_;

  std::mutex mutex_;  // of what follows
  Outbox outbox_;
  bool woken_ = false;
  bool overflowed_ = false;
};

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The other ends of a web server: one that keeps the rules and one that need not.
#pragma once
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <cstdint>
#include <functional>
#include <string>

namespace graspd {

/// Sends bytes as they are, and gives what comes back until the other end closes. Throws std::runtime_error
/// where it does not.
[[nodiscard]] std::string raw_exchange(std::uint16_t port, const std::string& bytes);

/// "GET target HTTP/1.1" with this host header and "Connection: close"; further headers end with \r\n each.
[[nodiscard]] std::string http_get(std::uint16_t port, const std::string& target,
                                   const std::string& headers = "", const std::string& host = "localhost");

/// A WebSocket of a client that keeps the rules. Throws boost::system::system_error where it is refused or
/// closed.
class SocketClient {
 public:
  explicit SocketClient(std::uint16_t port, const std::string& target = "/socket");

  void send(const std::string& message, bool is_text = true);
  /// The next message; throws std::runtime_error where none comes within a minute.
  [[nodiscard]] std::string receive();
  [[nodiscard]] bool got_text() const { return stream_.got_text(); }
  void close();
  boost::asio::ip::tcp::socket& socket() { return stream_.next_layer().socket(); }

 private:
  boost::asio::io_context context_;
  boost::beast::websocket::stream<boost::beast::tcp_stream> stream_;
};

/// Waits for it, a minute at most.
[[nodiscard]] bool becomes_true(const std::function<bool()>& condition);

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// One connection before it is a WebSocket: takes requests, answers them with files or refusals.
#pragma once
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/span_body.hpp>
#include <memory>
#include <optional>
#include <string_view>

#include "client/web/hub.hpp"

namespace graspd {

/// Shared: each operation that the network works on holds it alive.
class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
 public:
  HttpConnection(boost::asio::ip::tcp::socket socket, WebHub& hub);
  ~HttpConnection();

  void read_request();

 private:
  using Request = boost::beast::http::request<boost::beast::http::empty_body>;
  using Response = boost::beast::http::response<boost::beast::http::span_body<const char>>;

  void received(const boost::system::error_code& error);
  void answer(const Request& request);
  void upgrade(Request request, const RequestFacts& facts, const Target& target);
  void refuse(WebEvent event);
  void write(unsigned status, std::string_view content_type, std::string_view body, bool body_is_sent);

  boost::beast::tcp_stream stream_;
  WebHub& hub_;
  boost::beast::flat_buffer buffer_;
  std::optional<boost::beast::http::request_parser<boost::beast::http::empty_body>> parser_;
  Response response_;
  bool immutable_ = false;
  bool keep_alive_ = false;
  bool handed_over_ = false;  // to a WebSocket
};

}  // namespace graspd

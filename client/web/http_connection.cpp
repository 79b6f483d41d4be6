// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/web/http_connection.hpp"

#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <utility>

#include "client/web/web_socket.hpp"

namespace graspd {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
using boost::system::error_code;

// Scripts and styles from here alone, nothing in line, no frames around it.
constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; font-src 'self'; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

std::string_view view(beast::string_view text) {
  return {text.data(), text.size()};
}

std::optional<std::string_view> header(const http::fields& fields, http::field name) {
  const auto found = fields.find(name);
  if (found == fields.end()) return std::nullopt;
  return view(found->value());
}

unsigned status_of(WebEvent refusal) {
  switch (refusal) {
    case WebEvent::kNotFound:
      return 404;
    case WebEvent::kBadMethod:
      return 405;
    case WebEvent::kForeignHost:
      return 421;
    case WebEvent::kForeignOrigin:
      return 403;
    case WebEvent::kBadToken:
      return 401;
    case WebEvent::kTooMany:
      return 503;
    default:
      return 400;
  }
}

}  // namespace

HttpConnection::HttpConnection(boost::asio::ip::tcp::socket socket, WebHub& hub)
    : stream_(std::move(socket)), hub_(hub), buffer_(hub.config.max_request_bytes) {
  ++hub_.connections;
}

HttpConnection::~HttpConnection() {
  if (!handed_over_) --hub_.connections;
}

void HttpConnection::read_request() {
  parser_.emplace();
  parser_->header_limit(static_cast<std::uint32_t>(hub_.config.max_request_bytes));
  parser_->body_limit(0);
  stream_.expires_after(hub_.config.request_timeout);
  http::async_read(
      stream_, buffer_, *parser_,
      [self = shared_from_this()](const error_code& error, std::size_t) { self->received(error); });
}

void HttpConnection::received(const error_code& error) {
  if (!error) {
    answer(parser_->get());
    return;
  }
  // A connection that ends between requests, or is slow, is nothing to answer.
  if (error.category() != make_error_code(http::error::end_of_stream).category() ||
      error == http::error::end_of_stream)
    return;
  keep_alive_ = false;
  refuse(WebEvent::kBadRequest);
}

void HttpConnection::answer(const Request& request) {
  keep_alive_ = request.keep_alive();
  const RequestFacts facts{view(request.target()), header(request, http::field::host),
                           header(request, http::field::origin), header(request, http::field::authorization)};
  if (const auto refusal = check_host(hub_.rules, facts)) return refuse(*refusal);
  if (request.method() != http::verb::get && request.method() != http::verb::head)
    return refuse(WebEvent::kBadMethod);
  const std::optional<Target> target = parse_target(facts.target);
  if (!target) return refuse(WebEvent::kBadPath);
  if (beast::websocket::is_upgrade(request)) return upgrade(request, facts, *target);
  const Asset* asset = hub_.assets.find(target->path);
  if (asset == nullptr) return refuse(WebEvent::kNotFound);
  hub_.counters.add(WebEvent::kFile);
  immutable_ = asset->immutable;
  write(200, asset->content_type, asset->bytes, request.method() != http::verb::head);
}

void HttpConnection::upgrade(Request request, const RequestFacts& facts, const Target& target) {
  if (target.path != hub_.config.socket_path) return refuse(WebEvent::kNotFound);
  const SocketAccess access = check_socket(hub_.rules, facts, target);
  if (access.refusal) return refuse(*access.refusal);
  handed_over_ = true;
  std::make_shared<WebSocket>(std::move(stream_), hub_, access.may_write)->accept(std::move(request));
}

void HttpConnection::refuse(WebEvent event) {
  hub_.counters.add(event);
  immutable_ = false;
  write(status_of(event), "text/plain; charset=utf-8", name(event), true);
}

void HttpConnection::write(unsigned status, std::string_view content_type, std::string_view body,
                           bool body_is_sent) {
  response_ = Response(http::int_to_status(status), 11);
  response_.set(http::field::content_type, beast::string_view(content_type.data(), content_type.size()));
  response_.set("Content-Security-Policy", kPolicy);
  response_.set("X-Content-Type-Options", "nosniff");
  response_.set("Referrer-Policy", "no-referrer");
  response_.set("Cross-Origin-Opener-Policy", "same-origin");
  response_.set("Cross-Origin-Resource-Policy", "same-origin");
  response_.set(http::field::cache_control, immutable_ ? "max-age=31536000, immutable" : "no-cache");
  response_.keep_alive(keep_alive_);
  response_.content_length(body.size());
  if (body_is_sent) response_.body() = {body.data(), body.size()};
  const auto written = [self = shared_from_this()](const error_code& error, std::size_t) {
    if (error) return;
    if (self->keep_alive_) return self->read_request();
    error_code ignored;
    self->stream_.socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, ignored);
  };
  http::async_write(stream_, response_, written);
}

}  // namespace graspd

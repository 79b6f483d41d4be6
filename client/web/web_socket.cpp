// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/web/web_socket.hpp"

#include <algorithm>
#include <boost/asio/post.hpp>
#include <optional>
#include <utility>

namespace graspd {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using boost::system::error_code;

// What the kernel keeps of messages that a client has not taken: little, so that a slow one sees new frames.
constexpr int kSendBuffer = 256 << 10;

}  // namespace

WebSocket::WebSocket(beast::tcp_stream stream, WebHub& hub, bool may_write)
    : stream_(std::move(stream)),
      hub_(hub),
      client_{hub.next_id++, may_write},
      tokens_(hub.config.max_messages_per_s),
      last_message_(std::chrono::steady_clock::now()),
      outbox_(hub.config.max_waiting_bytes) {}

WebSocket::~WebSocket() {
  --hub_.connections;
}

void WebSocket::accept(Upgrade request) {
  request_ = std::move(request);
  beast::get_lowest_layer(stream_).expires_never();  // the WebSocket has a timeout of its own
  error_code ignored;
  beast::get_lowest_layer(stream_).socket().set_option(asio::socket_base::send_buffer_size(kSendBuffer),
                                                       ignored);
  websocket::stream_base::timeout timeout{};
  timeout.handshake_timeout = hub_.config.request_timeout;
  timeout.idle_timeout = hub_.config.silence_timeout;
  timeout.keep_alive_pings = true;
  stream_.set_option(timeout);
  stream_.read_message_max(hub_.config.max_message_bytes);
  stream_.auto_fragment(false);
  if (const std::string& protocol = hub_.config.subprotocol; !protocol.empty()) {
    const auto asked = request_[beast::http::field::sec_websocket_protocol];
    const bool wanted = std::string_view(asked.data(), asked.size()).find(protocol) != std::string_view::npos;
    if (wanted) {
      stream_.set_option(websocket::stream_base::decorator([protocol](websocket::response_type& response) {
        response.set(beast::http::field::sec_websocket_protocol, protocol);
      }));
    }
  }
  stream_.async_accept(request_,
                       [self = shared_from_this()](const error_code& error) { self->opened(error); });
}

void WebSocket::opened(const error_code& error) {
  if (error) {
    hub_.counters.add(WebEvent::kBadRequest);
    return;
  }
  open_ = true;
  hub_.counters.add(WebEvent::kClient);
  hub_.add(client_.id, shared_from_this());
  if (hub_.handlers.opened) hub_.handlers.opened(client_);
  read_next();
}

void WebSocket::read_next() {
  stream_.async_read(
      buffer_, [self = shared_from_this()](const error_code& error, std::size_t) { self->received(error); });
}

void WebSocket::received(const error_code& error) {
  if (error) {
    if (error == websocket::error::message_too_big || error == websocket::error::buffer_overflow)
      hub_.counters.add(WebEvent::kHugeMessage);
    ended();
    return;
  }
  if (floods()) {
    hub_.counters.add(WebEvent::kFlood);
    close(websocket::close_code::policy_error);
    return;
  }
  hub_.counters.add(WebEvent::kMessageIn);
  const auto data = buffer_.data();
  const std::string_view message(static_cast<const char*>(data.data()), data.size());
  if (hub_.handlers.received) hub_.handlers.received(client_, message, stream_.got_text());
  buffer_.consume(buffer_.size());
  if (open_) read_next();
}

bool WebSocket::floods() {
  const auto now = std::chrono::steady_clock::now();
  const double per_s = hub_.config.max_messages_per_s;
  const double passed_s = std::chrono::duration<double>(now - std::exchange(last_message_, now)).count();
  tokens_ = std::min(per_s, tokens_ + passed_s * per_s) - 1;
  return tokens_ < 0;
}

void WebSocket::put_latest(int topic, const WebMessage& message) {
  const std::scoped_lock lock(mutex_);
  if (outbox_.put_latest(topic, message)) hub_.counters.add(WebEvent::kReplaced);
  wake();
}

void WebSocket::put(const WebMessage& message) {
  const std::scoped_lock lock(mutex_);
  if (!outbox_.put(message)) overflowed_ = true;
  wake();
}

/// One call at a time waits at the server's thread, however much is put meanwhile.
void WebSocket::wake() {
  if (std::exchange(woken_, true)) return;
  asio::post(stream_.get_executor(), [self = shared_from_this()] { self->write_next(); });
}

void WebSocket::write_next() {
  std::optional<WebMessage> message;
  bool overflowed = false;
  {
    const std::scoped_lock lock(mutex_);
    woken_ = false;
    overflowed = std::exchange(overflowed_, false);
    if (open_ && !writing_ && !overflowed) message = outbox_.take();
  }
  if (overflowed && open_) {
    hub_.counters.add(WebEvent::kOverflow);
    beast::get_lowest_layer(stream_).close();  // it takes nothing, so no goodbye either
    return;
  }
  if (!message) return;
  writing_ = true;
  stream_.text(message->is_text);
  const auto bytes = asio::buffer(*message->bytes);
  stream_.async_write(
      bytes, [self = shared_from_this(), kept = message->bytes](const error_code& error, std::size_t size) {
        self->writing_ = false;
        if (error) return;  // the read that waits ends with it
        self->hub_.counters.add(WebEvent::kMessageOut);
        self->hub_.counters.add(WebEvent::kBytesOut, static_cast<std::int64_t>(size));
        self->write_next();
      });
}

void WebSocket::close(websocket::close_code code) {
  ended();
  // A write that is on its way does not end before a stuck client takes it: then without goodbye.
  if (writing_) {
    beast::get_lowest_layer(stream_).close();
    return;
  }
  stream_.async_close(code, [self = shared_from_this()](const error_code&) {});
}

void WebSocket::ended() {
  if (!std::exchange(open_, false)) return;
  hub_.remove(client_.id);
  if (hub_.handlers.closed) hub_.handlers.closed(client_);
}

}  // namespace graspd

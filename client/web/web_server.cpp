// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/web/web_server.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <utility>

#include "client/web/http_connection.hpp"
#include "client/web/hub.hpp"

namespace graspd {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

tcp::endpoint endpoint(const WebConfig& config) {
  error_code error;
  const std::string& text = config.address == "localhost" ? "127.0.0.1" : config.address;
  const auto address = asio::ip::make_address(text, error);
  if (error) throw std::runtime_error(config.address + ": not an IP address to listen on");
  return {address, config.port};
}

}  // namespace

class WebServer::Implementation {
 public:
  Implementation(WebConfig config, WebHandlers handlers)
      : hub(std::move(config), std::move(handlers)), acceptor_(context_), pause_(context_) {
    listen();
  }

  ~Implementation() {
    context_.stop();
    if (thread_.joinable()) thread_.join();
    // The peers go with the context, which holds their operations, and before the hub that they count in.
    hub.clear();
  }

  void start() {
    accept_next();
    thread_ = std::thread([this] { context_.run(); });
  }

  [[nodiscard]] std::uint16_t port() const { return port_; }

  WebHub hub;

 private:
  void listen() {
    const tcp::endpoint place = endpoint(hub.config);
    error_code error;
    acceptor_.open(place.protocol(), error);
    if (!error) acceptor_.set_option(asio::socket_base::reuse_address(true), error);
    if (!error) acceptor_.bind(place, error);
    if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
    if (error) {
      throw std::runtime_error(hub.config.address + ":" + std::to_string(hub.config.port) +
                               ": cannot listen there: " + error.message());
    }
    port_ = acceptor_.local_endpoint().port();
  }

  void accept_next() {
    acceptor_.async_accept([this](const error_code& error, tcp::socket socket) {
      if (!error) serve(std::move(socket));
      if (!error) return accept_next();
      // Out of descriptors, most likely: there will be some again.
      pause_.expires_after(std::chrono::milliseconds(200));
      pause_.async_wait([this](const error_code& stopped) {
        if (!stopped) accept_next();
      });
    });
  }

  void serve(tcp::socket socket) {
    hub.counters.add(WebEvent::kConnection);
    if (hub.connections >= hub.config.max_connections) {
      hub.counters.add(WebEvent::kTooMany);
      return;  // the socket closes itself
    }
    error_code ignored;
    socket.set_option(tcp::no_delay(true), ignored);
    std::make_shared<HttpConnection>(std::move(socket), hub)->read_request();
  }

  asio::io_context context_{1};
  tcp::acceptor acceptor_;
  asio::steady_timer pause_;
  std::uint16_t port_ = 0;
  std::thread thread_;
};

WebServer::WebServer(WebConfig config, WebHandlers handlers)
    : implementation_(std::make_unique<Implementation>(std::move(config), std::move(handlers))) {}
WebServer::~WebServer() = default;

void WebServer::start() {
  implementation_->start();
}

std::uint16_t WebServer::port() const {
  return implementation_->port();
}
const std::string& WebServer::token() const {
  return implementation_->hub.rules.token;
}

std::string WebServer::url() const {
  const std::string& address = implementation_->hub.config.address;
  const bool v6 = address.find(':') != std::string::npos;
  std::string url = v6 ? "http://[" : "http://";
  url += address;
  url += v6 ? "]:" : ":";
  return url + std::to_string(port()) + "/";
}

void WebServer::send_latest(std::int64_t client, int topic, WebMessage message) {
  implementation_->hub.with(client, [&](WebPeer& peer) { peer.put_latest(topic, message); });
}
void WebServer::broadcast_latest(int topic, const WebMessage& message) {
  implementation_->hub.for_each([&](WebPeer& peer) { peer.put_latest(topic, message); });
}
void WebServer::send(std::int64_t client, WebMessage message) {
  implementation_->hub.with(client, [&](WebPeer& peer) { peer.put(message); });
}
void WebServer::broadcast(const WebMessage& message) {
  implementation_->hub.for_each([&](WebPeer& peer) { peer.put(message); });
}

int WebServer::clients() const {
  return implementation_->hub.size();
}
const WebCounters& WebServer::counters() const {
  return implementation_->hub.counters;
}
WebCounters& WebServer::counters() {
  return implementation_->hub.counters;
}

}  // namespace graspd

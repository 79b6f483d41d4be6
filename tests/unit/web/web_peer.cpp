// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/web/web_peer.hpp"

#include <sys/socket.h>
#include <sys/time.h>

#include <array>
#include <boost/asio/write.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <cerrno>
#include <chrono>
#include <optional>
#include <stdexcept>
#include <thread>

namespace graspd {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;

tcp::endpoint local(std::uint16_t port) {
  return {asio::ip::address_v4::loopback(), port};
}

}  // namespace

std::string raw_exchange(std::uint16_t port, const std::string& bytes) {
  asio::io_context context;
  tcp::socket socket(context);
  socket.connect(local(port));
  const timeval patience{60, 0};
  setsockopt(socket.native_handle(), SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  boost::system::error_code error;
  asio::write(socket, asio::buffer(bytes), error);  // the other end may have closed already
  std::string answer;
  std::array<char, 4096> chunk{};
  while (true) {
    const auto size = recv(socket.native_handle(), chunk.data(), chunk.size(), 0);
    if (size < 0 && errno == EAGAIN) throw std::runtime_error("the server neither answered nor closed");
    if (size <= 0) return answer;
    answer.append(chunk.data(), static_cast<std::size_t>(size));
  }
}

std::string http_get(std::uint16_t port, const std::string& target, const std::string& headers,
                     const std::string& host) {
  std::string request = "GET ";
  request += target;
  request += " HTTP/1.1\r\nHost: ";
  request += host;
  request += "\r\nConnection: close\r\n";
  request += headers;
  return raw_exchange(port, request + "\r\n");
}

SocketClient::SocketClient(std::uint16_t port, const std::string& target) : stream_(context_) {
  stream_.next_layer().connect(local(port));
  stream_.read_message_max(64 << 20);
  stream_.handshake("localhost:" + std::to_string(port), target);
}

void SocketClient::send(const std::string& message, bool is_text) {
  stream_.text(is_text);
  stream_.write(asio::buffer(message));
}

std::string SocketClient::receive() {
  boost::beast::flat_buffer buffer;
  std::optional<boost::system::error_code> result;
  stream_.async_read(buffer,
                     [&result](const boost::system::error_code& error, std::size_t) { result = error; });
  context_.restart();
  context_.run_for(std::chrono::minutes(1));
  if (!result) {
    stream_.next_layer().cancel();
    context_.run();  // the read must not outlive its buffer
    throw std::runtime_error("the server sent nothing for a minute");
  }
  if (*result) throw boost::system::system_error(*result);
  return boost::beast::buffers_to_string(buffer.data());
}

void SocketClient::close() {
  stream_.close(boost::beast::websocket::close_code::normal);
}

bool becomes_true(const std::function<bool()>& condition) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

}  // namespace graspd

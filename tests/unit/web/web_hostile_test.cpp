// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What strangers send: refused, counted, and the server goes on.
#include <gtest/gtest.h>

#include <array>
#include <boost/asio/write.hpp>
#include <memory>
#include <random>
#include <vector>

#include "client/web/web_server.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/unit/web/web_peer.hpp"

namespace graspd {
namespace {

const std::string kUpgrade =
    "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";

class WebHostileTest : public testing::Test {
 protected:
  // Long enough for a machine that is busy with other things.
  void SetUp() override { start(std::chrono::minutes(10)); }
  void start(std::chrono::seconds request_timeout) {
    folder_.write("page/index.html", "page");
    folder_.write("secret.txt", "the secret");
    WebConfig config;
    config.assets = folder_ / "page";
    config.max_connections = 8;
    config.max_messages_per_s = 50;
    config.max_message_bytes = 1000;
    config.request_timeout = request_timeout;
    server_ = std::make_unique<WebServer>(config, WebHandlers{});
    server_->start();
  }
  void TearDown() override {
    // Whatever came before: the next one is served.
    EXPECT_TRUE(becomes_true([&] { return get("/").starts_with("HTTP/1.1 200"); }));
  }
  [[nodiscard]] std::string get(const std::string& target, const std::string& headers = "",
                                const std::string& host = "localhost") const {
    return http_get(server_->port(), target, headers, host);
  }
  /// An upgrade with these headers; refused, the connection ends.
  [[nodiscard]] std::string ask_socket(const std::string& headers,
                                       const std::string& target = "/socket") const {
    return raw_exchange(server_->port(),
                        "GET " + target + " HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade, close\r\n" +
                            kUpgrade + headers + "\r\n");
  }
  [[nodiscard]] std::int64_t count(WebEvent event) const { return server_->counters().get(event); }

  TempFolder folder_;
  std::unique_ptr<WebServer> server_;
};

TEST_F(WebHostileTest, PathsThatClimb) {
  for (const char* path : {"/../secret.txt", "/%2e%2e/secret.txt", "/..%2fsecret.txt", "/a/../../secret.txt",
                           "/%2e%2e%5csecret.txt", "//../secret.txt", "/index.html%00.txt"}) {
    const std::string answer = get(path);
    EXPECT_EQ(answer.find("the secret"), std::string::npos) << path;
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 400")) << path << ": " << answer;
  }
  EXPECT_EQ(count(WebEvent::kBadPath), 7);
}

TEST_F(WebHostileTest, NamesAndOriginsOfOthers) {
  EXPECT_TRUE(get("/", "", "rebound.example").starts_with("HTTP/1.1 421"));
  EXPECT_TRUE(ask_socket("Origin: http://evil.example\r\n").starts_with("HTTP/1.1 403"));
  EXPECT_TRUE(ask_socket("Origin: null\r\n").starts_with("HTTP/1.1 403"));
  EXPECT_TRUE(ask_socket("", "/socket?token=guess").starts_with("HTTP/1.1 401"));
  EXPECT_TRUE(ask_socket("", "/elsewhere").starts_with("HTTP/1.1 404"));
  EXPECT_EQ(count(WebEvent::kForeignHost), 1);
  EXPECT_EQ(count(WebEvent::kForeignOrigin), 2);
  EXPECT_EQ(count(WebEvent::kBadToken), 1);
  EXPECT_EQ(count(WebEvent::kClient), 0);
}

TEST_F(WebHostileTest, RequestsThatAreNone) {
  const std::uint16_t port = server_->port();
  EXPECT_TRUE(raw_exchange(port, "\x16\x03\x01 this is TLS\r\n\r\n").starts_with("HTTP/1.1 400"));
  EXPECT_TRUE(get("/", "X: " + std::string(20'000, 'x') + "\r\n").starts_with("HTTP/1.1 400"));
  EXPECT_TRUE(get("/", "Content-Length: 5\r\n").starts_with("HTTP/1.1 400"));
  EXPECT_TRUE(raw_exchange(port, "GET / HTTP/1.1\r\nConnection: close\r\n\r\n").starts_with("HTTP/1.1 400"));
  EXPECT_EQ(count(WebEvent::kBadRequest), 4);
  EXPECT_TRUE(raw_exchange(port, "DELETE / HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n")
                  .starts_with("HTTP/1.1 405"));
  EXPECT_EQ(count(WebEvent::kBadMethod), 1);
}

TEST_F(WebHostileTest, ARequestThatNeverEndsIsGivenUp) {
  start(std::chrono::seconds(1));
  EXPECT_EQ(raw_exchange(server_->port(), "GET / HTTP/1.1\r\nHost: loc"), "");
}

TEST_F(WebHostileTest, MoreConnectionsThanAllowed) {
  boost::asio::io_context context;
  std::vector<boost::asio::ip::tcp::socket> sockets;
  for (int i = 0; i < 30; ++i) {
    sockets.emplace_back(context);
    sockets.back().connect({boost::asio::ip::address_v4::loopback(), server_->port()});
  }
  EXPECT_TRUE(becomes_true([&] { return count(WebEvent::kTooMany) == 22; }));
  EXPECT_EQ(count(WebEvent::kConnection), 30);
}

TEST_F(WebHostileTest, HugeMessagesAndFloods) {
  SocketClient huge(server_->port());
  huge.send(std::string(1001, 'x'));
  EXPECT_ANY_THROW((void)huge.receive());
  EXPECT_TRUE(becomes_true([&] { return count(WebEvent::kHugeMessage) == 1 && server_->clients() == 0; }));

  SocketClient flood(server_->port());
  EXPECT_TRUE(becomes_true([&] {
    for (int i = 0; i < 100; ++i) flood.send("x");
    return count(WebEvent::kFlood) == 1;
  }));
  EXPECT_ANY_THROW((void)flood.receive());
  EXPECT_TRUE(becomes_true([&] { return server_->clients() == 0; }));
}

TEST_F(WebHostileTest, FramesThatPromiseMoreThanTheySend) {
  // A masked text frame of 2^62 bytes.
  const std::string frame("\x81\xff\x40\0\0\0\0\0\0\0mask", 14);
  SocketClient client(server_->port());
  boost::asio::write(client.socket(), boost::asio::buffer(frame));
  EXPECT_ANY_THROW((void)client.receive());
  EXPECT_TRUE(becomes_true([&] { return server_->clients() == 0; }));
  EXPECT_EQ(count(WebEvent::kHugeMessage), 1);
}

TEST_F(WebHostileTest, Noise) {
  std::mt19937 random(1);
  const std::array<std::string, 4> starts{
      "", "GET / HTTP/1.1\r\n",
      "GET /socket HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\n" + kUpgrade + "\r\n",
      "GET /socket HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\n" + kUpgrade + "\r\n\x81"};
  for (int i = 0; i < 60; ++i) {
    std::string bytes = starts[static_cast<std::size_t>(i) % starts.size()];
    for (int k = 0; k < 300; ++k) bytes += static_cast<char>(random());
    boost::asio::io_context context;
    boost::asio::ip::tcp::socket socket(context);
    socket.connect({boost::asio::ip::address_v4::loopback(), server_->port()});
    boost::system::error_code ignored;
    boost::asio::write(socket, boost::asio::buffer(bytes), ignored);
  }
  EXPECT_TRUE(becomes_true([&] { return server_->clients() == 0; }));
}

}  // namespace
}  // namespace graspd

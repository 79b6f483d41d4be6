// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/web/web_server.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <deque>
#include <mutex>
#include <optional>
#include <stdexcept>

#include "tests/support/temp_folder.hpp"
#include "tests/unit/web/web_peer.hpp"

namespace graspd {
namespace {

/// A server with a page, which answers what it gets with "echo:" before it.
class WebServerTest : public testing::Test {
 protected:
  void start(WebConfig config = {}) {
    folder_.write("index.html", "<title>page</title>");
    config.assets = folder_.path();
    WebHandlers handlers;
    handlers.opened = [this](const WebClient& client) {
      const std::scoped_lock lock(mutex_);
      opened_.push_back(client);
    };
    handlers.received = [this](const WebClient& client, std::string_view message, bool) {
      server_->send(client.id, text_message("echo:" + std::string(message)));
    };
    handlers.closed = [this](const WebClient&) { ++closed_; };
    server_.emplace(config, handlers);
    server_->start();
  }
  WebClient client(std::size_t i) {
    EXPECT_TRUE(becomes_true([&] {
      const std::scoped_lock lock(mutex_);
      return opened_.size() > i;
    }));
    const std::scoped_lock lock(mutex_);
    return opened_.at(i);
  }
  [[nodiscard]] std::int64_t count(WebEvent event) { return server_->counters().get(event); }

  TempFolder folder_;
  std::mutex mutex_;
  std::deque<WebClient> opened_;
  std::atomic<int> closed_ = 0;
  std::optional<WebServer> server_;
};

TEST_F(WebServerTest, ServesFilesWithHeadersThatKeepThePageToItself) {
  start();
  const std::string answer = http_get(server_->port(), "/");
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 200")) << answer;
  EXPECT_TRUE(answer.ends_with("\r\n\r\n<title>page</title>")) << answer;
  for (const char* part : {"Content-Security-Policy: default-src 'none'; script-src 'self';",
                           "X-Content-Type-Options: nosniff", "Content-Type: text/html; charset=utf-8"})
    EXPECT_NE(answer.find(part), std::string::npos) << part;
  EXPECT_TRUE(http_get(server_->port(), "/nothing.js").starts_with("HTTP/1.1 404"));
  EXPECT_EQ(count(WebEvent::kFile), 1);
  EXPECT_EQ(count(WebEvent::kNotFound), 1);
  EXPECT_EQ(server_->url(), "http://127.0.0.1:" + std::to_string(server_->port()) + "/");
}

TEST_F(WebServerTest, KeepsAConnectionForSeveralRequests) {
  start();
  const std::string request = "GET / HTTP/1.1\r\nHost: localhost\r\n\r\n";
  const std::string last = "HEAD / HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n";
  const std::string answer = raw_exchange(server_->port(), request + request + last);
  EXPECT_TRUE(answer.ends_with("\r\n\r\n")) << "HEAD has no body: " << answer;
  EXPECT_EQ(count(WebEvent::kFile), 3);
  EXPECT_EQ(count(WebEvent::kConnection), 1);
}

TEST_F(WebServerTest, CarriesMessagesBothWays) {
  start();
  SocketClient reader(server_->port());
  SocketClient writer(server_->port(), "/socket?token=" + server_->token());
  EXPECT_FALSE(client(0).may_write);
  EXPECT_TRUE(client(1).may_write);
  writer.send("hello");
  EXPECT_EQ(writer.receive(), "echo:hello");
  EXPECT_TRUE(writer.got_text());
  server_->send_latest(client(0).id, 7, binary_message(std::string("\0\1", 2)));
  EXPECT_EQ(reader.receive(), std::string("\0\1", 2));
  EXPECT_FALSE(reader.got_text());
  reader.close();
  EXPECT_TRUE(becomes_true([&] { return closed_ == 1 && server_->clients() == 1; }));
}

TEST_F(WebServerTest, ASlowClientGetsFewerMessagesAndSlowsNobody) {
  start();
  SocketClient slow(server_->port());
  SocketClient quick(server_->port());
  ASSERT_TRUE(becomes_true([&] { return server_->clients() == 2; }));  // a broadcast reaches who is there
  const auto big = [](int i) { return binary_message(std::to_string(i) + std::string(1 << 20, ' ')); };
  constexpr int kFrames = 60;
  for (int i = 0; i < kFrames; ++i) {  // the quick one takes each before the next comes
    server_->broadcast_latest(1, big(i));
    EXPECT_EQ(std::stoi(quick.receive()), i);
  }
  // The slow one has what the kernel holds, then the newest.
  int received = 1;
  while (std::stoi(slow.receive()) != kFrames - 1) ++received;
  EXPECT_LT(received, kFrames / 2);
  EXPECT_EQ(count(WebEvent::kReplaced), kFrames - received);
}

TEST_F(WebServerTest, AClientThatDoesNotTakeWhatMustNotBeLostIsClosed) {
  WebConfig config;
  config.max_waiting_bytes = 1 << 20;
  start(config);
  SocketClient stuck(server_->port());
  const WebMessage message = binary_message(std::string(1 << 19, ' '));
  EXPECT_TRUE(becomes_true([&] {
    server_->broadcast(message);
    return count(WebEvent::kOverflow) > 0;
  }));
  EXPECT_TRUE(becomes_true([&] { return closed_ == 1; }));
  EXPECT_EQ(server_->clients(), 0);
}

TEST_F(WebServerTest, SpeaksTheSubprotocolThatIsAskedFor) {
  WebConfig config;
  config.subprotocol = "graspd.test.v1";
  config.silence_timeout = std::chrono::seconds(1);  // the exchange below never says goodbye
  start(config);
  const std::string upgrade =
      "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";
  const auto ask = [&](const std::string& protocol) {
    std::string request =
        "GET /socket HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\n" + upgrade + protocol;
    return raw_exchange(server_->port(), request + "\r\n");
  };
  EXPECT_NE(ask("Sec-WebSocket-Protocol: graspd.test.v1\r\n").find("Sec-WebSocket-Protocol: graspd.test.v1"),
            std::string::npos);
  EXPECT_EQ(ask("").find("Sec-WebSocket-Protocol"), std::string::npos);
}

TEST_F(WebServerTest, EndsWhileClientsAreConnected) {
  start();
  SocketClient one(server_->port()), two(server_->port());
  ASSERT_TRUE(becomes_true([&] { return server_->clients() == 2; }));
  server_->broadcast_latest(1, binary_message(std::string(8 << 20, ' ')));
  server_.reset();
  EXPECT_ANY_THROW({
    (void)one.receive();
    (void)one.receive();
  });
}

TEST(WebServerStart, SaysWhyItCannot) {
  for (const char* address : {"0.0.0.0", "::", "nowhere"}) {  // two without a token, and none
    WebConfig config;
    config.address = address;
    EXPECT_THROW(WebServer(config, {}), std::runtime_error) << address;
  }
  const WebServer first({}, {});
  WebConfig taken;
  taken.port = first.port();
  EXPECT_THROW(WebServer(taken, {}), std::runtime_error);
}

}  // namespace
}  // namespace graspd

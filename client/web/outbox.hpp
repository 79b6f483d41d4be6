// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What waits to be sent to one client: bounded, whatever the client does.
#pragma once
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>

namespace graspd {

/// One message. The bytes are shared by all clients that it waits for: each keeps them until it has sent
/// them.
struct WebMessage {
  std::shared_ptr<const std::string> bytes;
  bool is_text = false;
};

[[nodiscard]] inline WebMessage text_message(std::string text) {
  return {std::make_shared<const std::string>(std::move(text)), true};
}
[[nodiscard]] inline WebMessage binary_message(std::string bytes) {
  return {std::make_shared<const std::string>(std::move(bytes)), false};
}

/// At most one message of each topic waits, and of those without one no more than a number of bytes. Not for
/// several threads at once.
class Outbox {
 public:
  explicit Outbox(std::size_t max_waiting_bytes) : max_waiting_bytes_(max_waiting_bytes) {}

  /// Takes the place of what waits of the topic; true when there was something.
  bool put_latest(int topic, WebMessage message);

  /// Must not be lost; false when there is no room.
  [[nodiscard]] bool put(WebMessage message);

  /// The next one to send; nothing: there is none.
  [[nodiscard]] std::optional<WebMessage> take();

  [[nodiscard]] std::size_t size() const { return waiting_.size(); }

 private:
  struct Entry {
    std::optional<int> topic;
    WebMessage message;
  };

  std::size_t max_waiting_bytes_;
  std::size_t waiting_bytes_ = 0;  // of those without a topic
  std::deque<Entry> waiting_;
};

}  // namespace graspd

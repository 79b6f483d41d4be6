// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/web/outbox.hpp"

#include <algorithm>
#include <utility>

namespace graspd {

bool Outbox::put_latest(int topic, WebMessage message) {
  const auto old =
      std::find_if(waiting_.begin(), waiting_.end(), [&](const Entry& e) { return e.topic == topic; });
  if (old != waiting_.end()) {
    old->message = std::move(message);  // in its place, or a topic that changes often would starve
    return true;
  }
  waiting_.push_back({topic, std::move(message)});
  return false;
}

bool Outbox::put(WebMessage message) {
  const std::size_t size = message.bytes->size();
  if (size > max_waiting_bytes_ - waiting_bytes_) return false;
  waiting_bytes_ += size;
  waiting_.push_back({std::nullopt, std::move(message)});
  return true;
}

std::optional<WebMessage> Outbox::take() {
  if (waiting_.empty()) return std::nullopt;
  Entry entry = std::move(waiting_.front());
  waiting_.pop_front();
  if (!entry.topic) waiting_bytes_ -= entry.message.bytes->size();
  return std::move(entry.message);
}

}  // namespace graspd

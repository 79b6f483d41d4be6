// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// A bounded queue that drops its oldest item rather than wait or grow.
#pragma once
#include <cstddef>
#include <deque>
#include <memory_resource>
#include <optional>
#include <utility>
#include <vector>

namespace graspd {

/// Not safe for threads by itself: FrameQueue locks around it.
template <class Item>
class Mailbox {
 public:
  /// At least 1.
  explicit Mailbox(std::size_t capacity) : capacity_(capacity < 1 ? 1 : capacity) {}

  /// The item that had to go, for its sender to be told.
  [[nodiscard]] std::optional<Item> push(Item item) {
    std::optional<Item> dropped;
    if (items_.size() == capacity_) dropped = pop();
    items_.push_back(std::move(item));
    return dropped;
  }

  /// At least 1. The items that had to go, oldest first.
  [[nodiscard]] std::vector<Item> set_capacity(std::size_t capacity) {
    capacity_ = capacity < 1 ? 1 : capacity;
    std::vector<Item> dropped;
    while (items_.size() > capacity_) dropped.push_back(std::move(*pop()));
    return dropped;
  }

  /// The oldest item; nothing when empty.
  [[nodiscard]] std::optional<Item> pop() {
    if (items_.empty()) return std::nullopt;
    std::optional<Item> item(std::move(items_.front()));
    items_.pop_front();
    return item;
  }

  [[nodiscard]] bool empty() const { return items_.empty(); }
  [[nodiscard]] std::size_t size() const { return items_.size(); }

 private:
  std::size_t capacity_;
  std::pmr::deque<Item> items_;
};

}  // namespace graspd

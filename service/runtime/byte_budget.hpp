// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// How many bytes may be held at a time.
#pragma once
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

namespace graspd {

/// All functions may be called from any thread; leases outlive the budget.
class ByteBudget {
 public:
  /// Bytes that count until it goes.
  class Lease {
   public:
    Lease() = default;
    Lease(Lease&& other) noexcept : used_(std::move(other.used_)), bytes_(std::exchange(other.bytes_, 0)) {}
    Lease& operator=(Lease&& other) noexcept {
      std::swap(used_, other.used_);
      std::swap(bytes_, other.bytes_);
      return *this;
    }
    Lease(const Lease&) = delete;
    Lease& operator=(const Lease&) = delete;
    ~Lease() {
      if (used_) *used_ -= bytes_;
    }

   private:
    friend class ByteBudget;
    Lease(std::shared_ptr<std::atomic<std::int64_t>> used, std::int64_t bytes)
        : used_(std::move(used)), bytes_(bytes) {}

    std::shared_ptr<std::atomic<std::int64_t>> used_;
    std::int64_t bytes_ = 0;
  };

  /// Nothing when more than `limit` would be held then.
  [[nodiscard]] std::optional<Lease> take(std::int64_t bytes, std::int64_t limit) {
    if (*used_ += bytes; *used_ <= limit) return Lease(used_, bytes);
    *used_ -= bytes;
    return std::nullopt;
  }
  [[nodiscard]] std::int64_t used() const { return *used_; }

 private:
  std::shared_ptr<std::atomic<std::int64_t>> used_ = std::make_shared<std::atomic<std::int64_t>>(0);
};

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Disjoint sets whose representative is the smallest member, whatever the order of the unions.
#pragma once
#include <cstdint>
#include <numeric>
#include <span>

#include "service/pipeline/raw_vector.hpp"

namespace graspd {

class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }

  [[nodiscard]] std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }

  void unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a < b)
      parent_[b] = a;
    else
      parent_[a] = b;
  }

  /// Afterwards the parent of each of these members is its representative. They must ascend, and be all that
  /// were ever united: parents are never larger than their children.
  void flatten(std::span<const std::uint32_t> members) {
    for (const std::uint32_t member : members) parent_[member] = parent_[parent_[member]];
  }

  [[nodiscard]] std::span<const std::uint32_t> parents() const { return parent_; }

 private:
  RawVector<std::uint32_t> parent_;
};

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What is sorted when points are brought into the order of cells.
#pragma once
#include <cstddef>
#include <cstdint>

namespace graspd {

/// Points that follow one another and lie in the cell with this key. The first one and how many there are
/// share one number: what is sorted stays small.
template <class Key>
struct CellRun {
  static constexpr int kSizeBits = 10;
  static constexpr Key kMostPoints = Key{1} << kSizeBits;
  /// Of the first points that there is room for.
  static constexpr std::uint64_t kFirstEnd = std::uint64_t{1} << (8 * sizeof(Key) - kSizeBits);

  Key key, points;

  CellRun() = default;
  CellRun(Key cell, std::size_t begin, std::size_t end)
      : key(cell), points(static_cast<Key>(begin << kSizeBits | (end - begin - 1))) {}
  [[nodiscard]] std::uint32_t first() const { return static_cast<std::uint32_t>(points >> kSizeBits); }
  [[nodiscard]] std::uint32_t size() const {
    return static_cast<std::uint32_t>(points & (kMostPoints - 1)) + 1;
  }
};

/// Whether a run begins with point i, which is not the first one: where another cell does, and so often that
/// no run is too long.
template <class Key>
[[nodiscard]] inline bool begins_run(const Key* keys, std::size_t i) {
  return keys[i] != keys[i - 1] || i % CellRun<Key>::kMostPoints == 0;
}

}  // namespace graspd

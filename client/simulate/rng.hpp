// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Random numbers that are the same on every machine and with every standard library.
#pragma once
#include <cstddef>
#include <cstdint>

namespace graspd {

/// Mixes the bits of a number (splitmix64's finaliser): neighbouring inputs give unrelated outputs.
[[nodiscard]] constexpr std::uint64_t hash(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// A seed for one of several independent sequences.
[[nodiscard]] constexpr std::uint64_t hash(std::uint64_t a, std::uint64_t b) {
  return hash(hash(a) ^ b);
}

class Rng {
 public:
  explicit constexpr Rng(std::uint64_t seed) : state_(hash(seed)) {}

  constexpr std::uint64_t bits() { return hash(state_ += 0x9e3779b97f4a7c15ULL); }

  /// In [0, 1).
  constexpr double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  constexpr double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /// In [0, n), n > 0.
  constexpr int index(int n) { return static_cast<int>(uniform() * n); }

  /// One of a range that is not empty.
  template <class Range>
  constexpr const auto& pick(const Range& range) {
    return range[static_cast<std::size_t>(index(static_cast<int>(range.size())))];
  }

  /// Nearly normal with mean 0 and deviation 1, within +-3.46: the sum of four 16-bit uniforms. No logarithm,
  /// so that no mathematical library has a say in the bits.
  constexpr double normal() {
    const std::uint64_t b = bits();
    const auto sum = (b & 0xffff) + ((b >> 16) & 0xffff) + ((b >> 32) & 0xffff) + (b >> 48);
    return (static_cast<double>(sum) - 2 * 65535.0) * (1.7320508075688772 / 65535.5);
  }

 private:
  std::uint64_t state_;
};

}  // namespace graspd

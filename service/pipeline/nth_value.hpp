// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Robust ends of a range of values: all but a few of them lie on one side.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <type_traits>

#include "service/pipeline/point_kernels.hpp"

namespace graspd {

/// The value that n others come before by less; n < values.size(). May change the order of the values. For
/// small n it takes one pass that rarely moves anything, where std::nth_element takes several.
template <class Less = std::less<>>
[[nodiscard]] float nth_value(std::span<float> values, std::size_t n, Less less = {}) {
  constexpr bool kLargest = std::is_same_v<Less, std::greater<>>;
  static_assert(kLargest || std::is_same_v<Less, std::less<>>);
  constexpr std::size_t kSmall = 24, kBlock = 16;
  if (n < kFew) {
    float few[kFew];
    point_kernels().first_few(values.data(), values.size(), kLargest, few);
    return few[n];
  }
  if (n >= kSmall) {
    const auto nth = values.begin() + static_cast<std::ptrdiff_t>(n);
    std::nth_element(values.begin(), nth, values.end(), less);
    return *nth;
  }
  std::array<float, kSmall + 1> first;  // so far, in order
  std::size_t size = 0;
  const auto put = [&](float value) {
    if (size > n && !less(value, first[n])) return;
    std::size_t k = size > n ? n : size++;
    for (; k > 0 && less(value, first[k - 1]); --k) first[k] = first[k - 1];
    first[k] = value;
  };
  std::size_t i = 0;
  for (; i < values.size() && size <= n; ++i) put(values[i]);
  // Most blocks have nothing to put, which vectors tell at once.
  for (; i + kBlock <= values.size(); i += kBlock) {
    int any = 0;
    for (std::size_t k = 0; k < kBlock; ++k) any |= int{less(values[i + k], first[n])};
    if (any == 0) continue;
    for (std::size_t k = 0; k < kBlock; ++k) put(values[i + k]);
  }
  for (; i < values.size(); ++i) put(values[i]);
  return first[n];
}

}  // namespace graspd

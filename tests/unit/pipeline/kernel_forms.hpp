// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The forms of the kernels that this processor has, and points to try them on.
#pragma once
#include <cstdint>
#include <memory_resource>
#include <numeric>
#include <random>
#include <vector>

#include "service/pipeline/point_kernels.hpp"

namespace graspd {

inline constexpr std::uint32_t kUntouched = 0xdeadbeef;

struct Form {
  const char* name;
  const PointKernels* kernels;
};

/// The portable one, and the one for AVX2 where this processor has it.
inline std::vector<Form> forms() {
  std::vector<Form> all{{"portable", &portable_kernels()}};
  if (avx2_kernels()) all.push_back({"avx2", avx2_kernels()});
  return all;
}

struct Points {
  std::pmr::vector<float> x, y, z;
  std::pmr::vector<std::uint32_t> index;
  std::size_t size;

  explicit Points(std::size_t n, std::uint32_t seed = 1)
      : x(n + kPointPadding), y(x), z(x), index(n + kPointPadding), size(n) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(-1, 1);
    // The padding holds points too, all of them inside: whoever counts it is found out.
    for (std::pmr::vector<float>* v : {&x, &y, &z})
      for (std::size_t i = 0; i < n; ++i) (*v)[i] = unit(random);
    std::iota(index.begin(), index.end(), 1000u);
  }
  [[nodiscard]] PointRange range() const { return {x.data(), y.data(), z.data(), index.data(), size}; }
  /// In three parts of which the middle one is empty.
  [[nodiscard]] std::vector<PointSpan> spans() const {
    const auto end = static_cast<std::uint32_t>(size), cut = end / 3;
    return {{0, cut}, {cut, cut}, {cut, end}};
  }
};

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Those of many points that are something's.
#pragma once
#include <cstdint>
#include <memory_resource>
#include <numeric>
#include <vector>

#include "service/pipeline/point_kernels.hpp"
#include "service/pipeline/raw_vector.hpp"

namespace graspd {

/// Those with a number that is not negative, ascending.
[[nodiscard]] inline RawVector<std::uint32_t> members(const std::pmr::vector<std::int32_t>& numbers) {
  RawVector<std::uint32_t> found(numbers.size() + kPointPadding);
  found.resize(point_kernels().list_members(numbers.data(), numbers.size(), found.data()));
  return found;
}

/// Those of n with a mark of 0, ascending; all of them where there are no marks.
[[nodiscard]] inline RawVector<std::uint32_t> unmarked(const std::pmr::vector<std::uint8_t>& marks,
                                                       std::size_t n) {
  RawVector<std::uint32_t> found(n + kPointPadding);
  if (marks.empty()) std::iota(found.begin(), found.end(), 0u);
  found.resize(marks.empty() ? n : point_kernels().list_unmarked(marks.data(), marks.size(), found.data()));
  return found;
}

}  // namespace graspd

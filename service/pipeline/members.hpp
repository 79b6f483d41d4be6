// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Those of many points that are something's.
#pragma once
#include <cstdint>
#include <memory_resource>
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

/// Those with a mark of 0, ascending.
[[nodiscard]] inline RawVector<std::uint32_t> unmarked(const std::pmr::vector<std::uint8_t>& marks) {
  RawVector<std::uint32_t> found(marks.size() + kPointPadding);
  found.resize(point_kernels().list_unmarked(marks.data(), marks.size(), found.data()));
  return found;
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Runs of points in one cell, and how they are sorted by it. Included by cell_order.cpp and the
// kernels that do parts of it alone.
#pragma once
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <utility>
#include <vector>

#include "service/pipeline/point_kernels.hpp"
#include "service/pipeline/raw_vector.hpp"

namespace graspd {

inline constexpr std::size_t kPart = 32768;  // points or runs that one thread takes at a time

/// Calls work(p, begin, end) for parts of n items; they may run beside each other.
template <class Work>
void for_each_part(std::size_t n, Work work) {
  tbb::parallel_for(std::size_t{0}, (n + kPart - 1) / kPart,
                    [&](std::size_t p) { work(p, p * kPart, std::min(n, (p + 1) * kPart)); });
}

/// From the sizes of parts to where they begin; returns the sum.
template <class Sizes>
std::size_t set_begins(Sizes& sizes) {
  std::size_t sum = 0;
  for (auto& size : sizes) sum += std::exchange(size, static_cast<std::uint32_t>(sum));
  return sum;
}

/// How many runs there are among keys [begin, end) of a part, which begins one.
template <class Key>
std::size_t count_runs(const Key* keys, std::size_t begin, std::size_t end) {
  static_assert(kPart % CellRun<Key>::kMostPoints == 0);
  std::size_t num = 1;
  if constexpr (sizeof(Key) == sizeof(std::uint32_t)) {
    num += point_kernels().count_changes(keys + begin, end - begin);
    for (std::size_t i = begin + CellRun<Key>::kMostPoints; i < end; i += CellRun<Key>::kMostPoints)
      num += keys[i] == keys[i - 1] ? 1 : 0;
  } else {
    for (std::size_t i = begin + 1; i < end; ++i) num += begins_run(keys, i) ? 1 : 0;
  }
  return num;
}

/// Writes the runs among keys [begin, end).
template <class Key>
void write_runs(const Key* keys, std::size_t begin, std::size_t end, CellRun<Key>* out) {
  std::size_t first = begin;
  for (std::size_t i = begin + 1; i < end; ++i) {
    if (!begins_run(keys, i)) continue;
    *out++ = {keys[first], first, i};
    first = i;
  }
  if (first < end) *out = {keys[first], first, end};
}

/// Points of one cell that follow one another in the cloud: images and sorted voxels have long runs of them,
/// which are sorted as one.
template <class Key>
RawVector<CellRun<Key>> find_runs(const RawVector<Key>& keys) {
  const std::size_t n = keys.size();
  std::pmr::vector<std::uint32_t> begins((n + kPart - 1) / kPart);
  for_each_part(n, [&](std::size_t p, std::size_t begin, std::size_t end) {
    begins[p] = static_cast<std::uint32_t>(count_runs(keys.data(), begin, end));
  });
  RawVector<CellRun<Key>> runs;
  const std::size_t num_runs = set_begins(begins);
  runs.resize(num_runs);
  begins.push_back(static_cast<std::uint32_t>(num_runs));
  for_each_part(n, [&](std::size_t p, std::size_t begin, std::size_t end) {
    CellRun<Key>* out = runs.data() + begins[p];
    if constexpr (sizeof(Key) == sizeof(std::uint32_t))
      point_kernels().write_runs(keys.data(), begin, end, out, begins[p + 1] - begins[p]);
    else
      write_runs(keys.data(), begin, end, out);
  });
  return runs;
}

template <class Key>
bool begins_cell(const CellRun<Key>* list, std::size_t r) {
  return r == 0 || list[r].key != list[r - 1].key;
}

/// Of sorted runs [begin, end).
template <class Key>
CellCounts count_cells(const CellRun<Key>* list, std::size_t begin, std::size_t end) {
  CellCounts sum;
  for (std::size_t r = begin; r < end; ++r) {
    sum.cells += begins_cell(list, r) ? 1 : 0;
    sum.points += list[r].size();
  }
  return sum;
}

/// Writes the points of sorted runs [begin, end), and those cells that begin there.
template <class Key>
void write_cells(const CellRun<Key>* list, std::size_t begin, std::size_t end, CellOutput out) {
  std::uint32_t at = out.first;
  for (std::size_t r = begin; r < end; ++r) {
    if (begins_cell(list, r)) {
      *out.keys++ = static_cast<std::int64_t>(list[r].key);
      *out.starts++ = at;
    }
    const std::uint32_t first = list[r].first(), last = first + list[r].size();
    for (std::uint32_t i = first; i != last; ++i) out.points[at++] = i;
  }
}

/// One pass of a stable radix sort of runs over one digit of their keys, in parts that can run beside each
/// other.
class DigitPass {
 public:
  DigitPass(std::size_t num_runs, int bits)
      : num_runs_(num_runs),
        bits_(bits),
        num_values_(std::size_t{1} << bits),
        num_parts_(std::clamp<std::size_t>(num_runs / kPart, 1, kMostParts)),
        next_(num_parts_ * num_values_) {}

  template <class Key>
  void move(int place, const CellRun<Key>* from, CellRun<Key>* to) {
    const int shift = place * bits_;
    const Key mask = static_cast<Key>(num_values_ - 1);
    for_each([=, this](std::uint32_t* next, std::size_t begin, std::size_t end) {
      std::fill_n(next, num_values_, 0u);
#pragma GCC unroll 4
      for (std::size_t i = begin; i < end; ++i) ++next[(from[i].key >> shift) & mask];
    });
    // By value, then by part.
    std::uint32_t sum = 0;
    for (std::size_t value = 0; value < num_values_; ++value)
      for (std::size_t p = 0; p < num_parts_; ++p) sum += std::exchange(next_[p * num_values_ + value], sum);
    for_each([=](std::uint32_t* next, std::size_t begin, std::size_t end) {
#pragma GCC unroll 4
      for (std::size_t i = begin; i < end; ++i) to[next[(from[i].key >> shift) & mask]++] = from[i];
    });
  }

 private:
  static constexpr std::size_t kMostParts = 4;

  template <class Work>
  void for_each(Work work) {
    const auto part = [&](std::size_t p) {
      work(next_.data() + p * num_values_, num_runs_ * p / num_parts_, num_runs_ * (p + 1) / num_parts_);
    };
    if (num_parts_ == 1)
      part(0);
    else
      tbb::parallel_for(std::size_t{0}, num_parts_, part);
  }

  std::size_t num_runs_;
  int bits_;
  std::size_t num_values_, num_parts_;
  RawVector<std::uint32_t> next_;  // where the next run with each value goes, by part
};

/// By key; stable. Radix sort, least significant digit first, over the lowest num_bits.
template <class Key>
void sort_by_key(RawVector<CellRun<Key>>& runs, int num_bits) {
  // Points that come from voxels of the same grid, for example.
  if (std::ranges::is_sorted(runs, {}, &CellRun<Key>::key)) return;
  // No more values than runs, and no more of them than stay in the second-level cache.
  const int most_bits = std::clamp(static_cast<int>(std::bit_width(runs.size())), 8, 15);
  const int num_places = std::max(1, (num_bits + most_bits - 1) / most_bits);
  DigitPass pass(runs.size(), (num_bits + num_places - 1) / num_places);
  RawVector<CellRun<Key>> sorted(runs.size());
  for (int place = 0; place < num_places; ++place) {
    pass.move(place, runs.data(), sorted.data());
    runs.swap(sorted);
  }
}

}  // namespace graspd

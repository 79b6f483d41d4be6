// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What points are brought into order with, in both forms. Nothing is computed but positions.
#include <bit>

#include "service/pipeline/avx2_lanes.hpp"
#include "service/pipeline/cell_runs.hpp"
#include "service/pipeline/surface_kernels.hpp"

namespace graspd {
namespace portable {
namespace {

void copy_point(const PointRange& points, std::size_t i, const LocalOutput& out, std::size_t to) {
  out.a[to] = points.x[i];
  out.f[to] = points.y[i];
  out.z[to] = points.z[i];
  if (out.index != nullptr) out.index[to] = static_cast<std::uint32_t>(i);
}

}  // namespace

std::size_t count_changes(const std::uint32_t* keys, std::size_t n) {
  std::uint32_t num = 0;
  for (std::size_t i = 1; i < n; ++i) num += keys[i] != keys[i - 1] ? 1 : 0;
  return num;
}

void write_runs(const std::uint32_t* keys, std::size_t begin, std::size_t end, CellRun<std::uint32_t>* out,
                std::size_t /*num*/) {
  graspd::write_runs(keys, begin, end, out);
}

CellCounts count_cells(const CellRun<std::uint32_t>* list, std::size_t begin, std::size_t end) {
  return graspd::count_cells(list, begin, end);
}

void write_cells(const CellRun<std::uint32_t>* list, std::size_t begin, std::size_t end, CellOutput out) {
  graspd::write_cells(list, begin, end, out);
}

void copy_at(const PointRange& points, std::span<const std::uint32_t> positions, const LocalOutput& out) {
  for (std::size_t k = 0; k < positions.size(); ++k) copy_point(points, positions[k], out, k);
}

}  // namespace portable

#if defined(__x86_64__)

namespace avx2 {
namespace {

GRASPD_AVX2 inline __m256i iota() {
  return _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
}

GRASPD_AVX2 inline __m256i from(std::size_t first) {
  return _mm256_add_epi32(iota(), _mm256_set1_epi32(static_cast<int>(first)));
}

GRASPD_AVX2 inline void store_all(void* to, __m256i v) {
  _mm256_storeu_si256(static_cast<__m256i*>(to), v);
}

/// The lanes of the eight points from i on that begin a run.
GRASPD_AVX2 inline unsigned run_begins(const std::uint32_t* keys, std::size_t i) {
  const __m256i same = _mm256_cmpeq_epi32(load(keys + i), load(keys + i - 1));
  const unsigned changes = static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(same))) ^ 0xff;
  const std::size_t to_next = (0 - i) % CellRun<std::uint32_t>::kMostPoints;
  return to_next < 8 ? changes | 1u << to_next : changes;
}

/// The sum of each lane and those before it.
GRASPD_AVX2 inline __m256i sums_up_to(__m256i v) {
  v = _mm256_add_epi32(v, _mm256_slli_si256(v, 4));
  v = _mm256_add_epi32(v, _mm256_slli_si256(v, 8));
  const __m256i lower = _mm256_permutevar8x32_epi32(v, _mm256_set1_epi32(3));
  return _mm256_add_epi32(v, _mm256_blend_epi32(_mm256_setzero_si256(), lower, 0xf0));
}

/// Eight runs.
struct EightRuns {
  __m256i keys, points;
};

GRASPD_AVX2 inline EightRuns load_runs(const CellRun<std::uint32_t>* list) {
  const __m256 a = _mm256_castsi256_ps(load(list)), b = _mm256_castsi256_ps(load(list + 4));
  // Of each half of a and b in turns.
  const __m256i keys = _mm256_castps_si256(_mm256_shuffle_ps(a, b, 0x88)),
                points = _mm256_castps_si256(_mm256_shuffle_ps(a, b, 0xdd));
  return {_mm256_permute4x64_epi64(keys, 0xd8), _mm256_permute4x64_epi64(points, 0xd8)};
}

/// From the first points of runs, in the place of what runs are packed in, to both; end: of the last one.
GRASPD_AVX2 void pack(CellRun<std::uint32_t>* runs, std::size_t num, std::size_t end) {
  constexpr int kSizeBits = CellRun<std::uint32_t>::kSizeBits;
  std::size_t r = 0;
  for (; r + 4 < num; r += 4) {
    const __m256i here = load(runs + r), size = _mm256_sub_epi32(load(runs + r + 1), here);
    const __m256i packed =
        _mm256_add_epi32(_mm256_slli_epi32(here, kSizeBits), _mm256_sub_epi32(size, _mm256_set1_epi32(1)));
    store_all(runs + r, _mm256_blend_epi32(here, packed, 0xaa));
  }
  for (; r < num; ++r) runs[r] = {runs[r].key, runs[r].points, r + 1 < num ? runs[r + 1].points : end};
}

}  // namespace

GRASPD_AVX2 std::size_t count_changes(const std::uint32_t* keys, std::size_t n) {
  __m256i same = _mm256_setzero_si256();  // less one for each
  std::size_t i = 1;
  for (; i + 8 <= n; i += 8)
    same = _mm256_add_epi32(same, _mm256_cmpeq_epi32(load(keys + i), load(keys + i - 1)));
  alignas(32) std::int32_t lanes[8];
  _mm256_store_si256(reinterpret_cast<__m256i*>(lanes), same);
  std::size_t num = i - 1;
  for (const std::int32_t lane : lanes) num -= static_cast<std::size_t>(-lane);
  return num + portable::count_changes(keys + i - 1, n - (i - 1));
}

GRASPD_AVX2 void write_runs(const std::uint32_t* keys, std::size_t begin, std::size_t end,
                            CellRun<std::uint32_t>* out, std::size_t num) {
  if (begin == end) return;
  const auto write_first = [&](std::size_t r, std::size_t i) {
    out[r].key = keys[i];
    out[r].points = static_cast<std::uint32_t>(i);
  };
  write_first(0, begin);
  std::size_t i = begin + 1, r = 1;
  for (; i + 8 <= end && r + 8 <= num; i += 8) {
    const unsigned mask = run_begins(keys, i);
    if (mask == 0) continue;
    const __m256i lanes = lanes_of(mask), key = _mm256_permutevar8x32_epi32(load(keys + i), lanes),
                  first = _mm256_permutevar8x32_epi32(from(i), lanes);
    const __m256i low = _mm256_unpacklo_epi32(key, first), high = _mm256_unpackhi_epi32(key, first);
    store_all(out + r, _mm256_permute2x128_si256(low, high, 0x20));
    store_all(out + r + 4, _mm256_permute2x128_si256(low, high, 0x31));
    r += static_cast<std::size_t>(std::popcount(mask));
  }
  for (; i < end; ++i)
    if (begins_run(keys, i)) write_first(r++, i);
  pack(out, num, end);
}

GRASPD_AVX2 CellCounts count_cells(const CellRun<std::uint32_t>* list, std::size_t begin, std::size_t end) {
  if (begin == end) return {};
  CellCounts sum = graspd::count_cells(list, begin, begin + 1);
  std::size_t r = begin + 1;
  // Keys and what goes with them in turns: both take part, and half of it counts.
  __m256i same = _mm256_setzero_si256(), sizes = same;  // sizes are less one for each
  const __m256i size_bits = _mm256_set1_epi32(CellRun<std::uint32_t>::kMostPoints - 1);
  for (; r + 4 <= end; r += 4) {
    const __m256i runs = load(list + r);
    same = _mm256_sub_epi32(same, _mm256_cmpeq_epi32(runs, load(list + r - 1)));
    sizes = _mm256_add_epi32(sizes, _mm256_and_si256(runs, size_bits));
  }
  alignas(32) std::uint32_t num_same[8], sum_of_sizes[8];
  _mm256_store_si256(reinterpret_cast<__m256i*>(num_same), same);
  _mm256_store_si256(reinterpret_cast<__m256i*>(sum_of_sizes), sizes);
  const auto num = static_cast<std::uint32_t>(r - begin - 1);
  sum.cells += num - (num_same[0] + num_same[2] + num_same[4] + num_same[6]);
  sum.points += num + sum_of_sizes[1] + sum_of_sizes[3] + sum_of_sizes[5] + sum_of_sizes[7];
  const CellCounts rest = graspd::count_cells(list, r, end);
  return {sum.cells + rest.cells, sum.points + rest.points};
}

GRASPD_AVX2 void write_cells(const CellRun<std::uint32_t>* list, std::size_t begin, std::size_t end,
                             CellOutput out) {
  constexpr int kSizeBits = CellRun<std::uint32_t>::kSizeBits;
  const __m256i size_bits = _mm256_set1_epi32(CellRun<std::uint32_t>::kMostPoints - 1);
  const __m256i one = _mm256_set1_epi32(1);
  alignas(32) std::uint32_t first[8], at[8], size[8];
  std::size_t r = begin;
  const auto go_on = [&](std::uint32_t num_cells, std::uint32_t position) {
    out.keys += num_cells;
    out.starts += num_cells;
    out.num_cells -= num_cells;
    out.first = position;
  };
  if (begin == 0 && end > 0) {
    graspd::write_cells(list, 0, 1, out);
    go_on(1, out.first + list[r++].size());
  }
  for (; r + 8 <= end && out.num_cells >= 8; r += 8) {
    const EightRuns runs = load_runs(list + r), before = load_runs(list + r - 1);
    const __m256i sizes = _mm256_add_epi32(_mm256_and_si256(runs.points, size_bits), one);
    const __m256i ends = _mm256_add_epi32(sums_up_to(sizes), _mm256_set1_epi32(static_cast<int>(out.first)));
    const auto next = static_cast<std::uint32_t>(_mm256_extract_epi32(ends, 7));
    if (next + 8 > out.last) break;
    const __m256i starts = _mm256_sub_epi32(ends, sizes);
    const auto same = static_cast<unsigned>(
        _mm256_movemask_ps(_mm256_castsi256_ps(_mm256_cmpeq_epi32(runs.keys, before.keys))));
    const unsigned mask = same ^ 0xff;
    const __m256i lanes = lanes_of(mask), keys = _mm256_permutevar8x32_epi32(runs.keys, lanes);
    store_all(out.keys, _mm256_cvtepu32_epi64(_mm256_castsi256_si128(keys)));
    store_all(out.keys + 4, _mm256_cvtepu32_epi64(_mm256_extracti128_si256(keys, 1)));
    store_all(out.starts, _mm256_permutevar8x32_epi32(starts, lanes));
    store_all(first, _mm256_srli_epi32(runs.points, kSizeBits));
    store_all(at, starts);
    // In blocks, of which the last one brings some of what follows: the next run overwrites it.
    for (int k = 0; k < 8; ++k) store_all(out.points + at[k], from(first[k]));
    if (_mm256_movemask_epi8(_mm256_cmpgt_epi32(sizes, _mm256_set1_epi32(8))) != 0) {
      store_all(size, sizes);
      for (int k = 0; k < 8; ++k)
        for (std::uint32_t i = 8; i < size[k]; ++i) out.points[at[k] + i] = first[k] + i;
    }
    go_on(static_cast<std::uint32_t>(std::popcount(mask)), next);
  }
  graspd::write_cells(list, r, end, out);
}

GRASPD_AVX2 void copy_at(const PointRange& points, std::span<const std::uint32_t> positions,
                         const LocalOutput& out) {
  std::size_t k = 0;
  for (; k + 8 <= positions.size(); k += 8) {
    const __m256i i = load(positions.data() + k);
    _mm256_storeu_ps(out.a + k, _mm256_i32gather_ps(points.x, i, sizeof(float)));
    _mm256_storeu_ps(out.f + k, _mm256_i32gather_ps(points.y, i, sizeof(float)));
    _mm256_storeu_ps(out.z + k, _mm256_i32gather_ps(points.z, i, sizeof(float)));
    if (out.index != nullptr) store_all(out.index + k, i);
  }
  for (; k < positions.size(); ++k) portable::copy_point(points, positions[k], out, k);
}

}  // namespace avx2

#endif

}  // namespace graspd

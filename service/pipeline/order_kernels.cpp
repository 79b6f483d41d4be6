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

/// The runs that begin among keys [i, end); r: number of the next.
void write_rest(const std::uint32_t* keys, std::size_t i, std::size_t end, std::size_t r,
                const RunOutput& out) {
  for (; i < end; ++i) {
    if (keys[i] == keys[i - 1]) continue;
    out.starts[r] = static_cast<std::uint32_t>(i);
    out.list[r] = {keys[i], static_cast<std::uint32_t>(r)};
    ++r;
  }
}

void write_first(const std::uint32_t* keys, std::size_t begin, const RunOutput& out) {
  out.starts[out.first] = static_cast<std::uint32_t>(begin);
  out.list[out.first] = {keys[begin], static_cast<std::uint32_t>(out.first)};
}

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

void write_runs(const std::uint32_t* keys, std::size_t begin, std::size_t end, const RunOutput& out) {
  if (begin == end) return;
  write_first(keys, begin, out);
  write_rest(keys, begin + 1, end, out.first + 1, out);
}

void write_cells(const CellRun<std::uint32_t>* list, std::size_t begin, std::size_t end,
                 const std::uint32_t* firsts, CellOutput out) {
  graspd::write_cells(list, begin, end, firsts, out);
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

/// The lanes of eight keys that differ from the one before.
GRASPD_AVX2 inline unsigned changes(const std::uint32_t* keys) {
  const __m256i same = _mm256_cmpeq_epi32(load(keys), load(keys - 1));
  return static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(same))) ^ 0xff;
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
                            const RunOutput& out) {
  if (begin == end) return;
  portable::write_first(keys, begin, out);
  std::size_t i = begin + 1, r = out.first + 1;
  for (; i + 8 <= end && r + 8 <= out.last; i += 8) {
    const unsigned mask = changes(keys + i);
    if (mask == 0) continue;
    const __m256i lanes = lanes_of(mask), number = from(r),
                  key = _mm256_permutevar8x32_epi32(load(keys + i), lanes);
    store_all(out.starts + r, _mm256_permutevar8x32_epi32(from(i), lanes));
    const __m256i low = _mm256_unpacklo_epi32(key, number), high = _mm256_unpackhi_epi32(key, number);
    store_all(out.list + r, _mm256_permute2x128_si256(low, high, 0x20));
    store_all(out.list + r + 4, _mm256_permute2x128_si256(low, high, 0x31));
    r += static_cast<std::size_t>(std::popcount(mask));
  }
  portable::write_rest(keys, i, end, r, out);
}

GRASPD_AVX2 void write_cells(const CellRun<std::uint32_t>* list, std::size_t begin, std::size_t end,
                             const std::uint32_t* firsts, CellOutput out) {
  std::uint32_t at = out.first;
  for (std::size_t r = begin; r < end; ++r) {
    if (r == 0 || list[r].key != list[r - 1].key) {
      *out.keys++ = std::int64_t{list[r].key};
      *out.starts++ = at;
    }
    const std::uint32_t first = firsts[list[r].number], last = firsts[list[r].number + 1];
    // In blocks, of which the last one brings some of what follows: the next run overwrites it.
    std::uint32_t i = first, to = at;
    for (; i < last && to + 8 <= out.last; i += 8, to += 8) store_all(out.points + to, from(i));
    for (; i < last; ++i) out.points[to++] = i;
    at += last - first;
  }
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

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Eight points at a time. Products and sums stay separate operations: fused ones would give other bits than
// the portable form.
#include "service/pipeline/avx2_lanes.hpp"

#if defined(__x86_64__)

namespace graspd {
namespace {

using namespace avx2;

struct Box {
  __m256 m[3][3], shift[3], min[3], max[3];

  GRASPD_AVX2 explicit Box(const BoxTest& box) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) m[i][j] = _mm256_set1_ps(box.to_local[i][j]);
      shift[i] = _mm256_set1_ps(box.shift[i]);
      min[i] = _mm256_set1_ps(box.min[i]);
      max[i] = _mm256_set1_ps(box.max[i]);
    }
  }

  GRASPD_AVX2 __m256 local(int i, __m256 x, __m256 y, __m256 z) const {
    const __m256 xy = _mm256_add_ps(_mm256_mul_ps(m[i][0], x), _mm256_mul_ps(m[i][1], y));
    return _mm256_add_ps(_mm256_add_ps(xy, _mm256_mul_ps(m[i][2], z)), shift[i]);
  }

  GRASPD_AVX2 __m256 within(int i, __m256 v) const {
    return _mm256_and_ps(_mm256_cmp_ps(v, min[i], _CMP_GE_OQ), _mm256_cmp_ps(v, max[i], _CMP_LE_OQ));
  }
};

struct LocalBlock {
  __m256 a, f, z;
};

/// Which of the eight points from k on are inside. A box is thin along the first axis: most blocks fail
/// there.
GRASPD_AVX2 inline unsigned inside_lanes(const Box& box, const PointRange& points, std::size_t k,
                                         LocalBlock& local) {
  const __m256 x = _mm256_loadu_ps(points.x + k), y = _mm256_loadu_ps(points.y + k),
               z = _mm256_loadu_ps(points.z + k);
  local.a = box.local(0, x, y, z);
  const __m256 within = box.within(0, local.a);
  if (_mm256_testz_ps(within, within)) return 0;
  local.f = box.local(1, x, y, z);
  local.z = box.local(2, x, y, z);
  return static_cast<unsigned>(_mm256_movemask_ps(
      _mm256_and_ps(_mm256_and_ps(within, box.within(1, local.f)), box.within(2, local.z))));
}

GRASPD_AVX2 inline std::size_t write_lanes(unsigned mask, const LocalBlock& local, const std::uint32_t* index,
                                           const LocalOutput& out, std::size_t n) {
  const __m256i lanes = lanes_of(mask);
  store(out.a + n, local.a, lanes);
  store(out.f + n, local.f, lanes);
  store(out.z + n, local.z, lanes);
  store_index(out.index + n, index, lanes);
  return n + static_cast<std::size_t>(std::popcount(mask));
}

GRASPD_AVX2 std::size_t keep_inside(const BoxTest& test, const PointRange& points,
                                    std::span<const PointSpan> spans, const LocalOutput& out) {
  const Box box(test);
  LocalBlock local;
  std::size_t n = 0;
  for (const PointSpan& span : spans) {
    std::size_t k = span.begin;
    for (; k + 8 <= span.end; k += 8)
      if (const unsigned mask = inside_lanes(box, points, k, local); mask != 0)
        n = write_lanes(mask, local, points.index + k, out, n);
    if (k == span.end) continue;
    if (const unsigned mask = inside_lanes(box, points, k, local) & first_lanes(span.end - k); mask != 0)
      n = write_lanes(mask, local, points.index + k, out, n);
  }
  return n;
}

GRASPD_AVX2 std::size_t count_inside(const BoxTest& test, const PointRange& points,
                                     std::span<const PointSpan> spans, std::size_t enough) {
  const Box box(test);
  LocalBlock local;
  std::size_t n = 0;
  for (auto span = spans.begin(); span != spans.end() && n <= enough; ++span) {
    std::size_t k = span->begin;
    for (; k + 8 <= span->end; k += 8)
      n += static_cast<std::size_t>(std::popcount(inside_lanes(box, points, k, local)));
    if (k == span->end) continue;
    const unsigned mask = inside_lanes(box, points, k, local) & first_lanes(span->end - k);
    n += static_cast<std::size_t>(std::popcount(mask));
  }
  return n;
}

/// Sums of the eight lanes of eight vectors, each in the order of its lanes.
GRASPD_AVX2 inline __m256 sums_of_lanes(const __m256* v) {
  __m256 pairs[8], fours[8];
  for (int i = 0; i < 4; ++i) {
    pairs[2 * i] = _mm256_unpacklo_ps(v[2 * i], v[2 * i + 1]);
    pairs[2 * i + 1] = _mm256_unpackhi_ps(v[2 * i], v[2 * i + 1]);
  }
  // Of the vectors 0 to 3 and 4 to 7 the lanes 0 and 4, 1 and 5, and so on.
  for (int i = 0; i < 8; i += 4)
    for (int k = 0; k < 2; ++k) {
      fours[i + 2 * k] = _mm256_shuffle_ps(pairs[i + k], pairs[i + k + 2], 0x44);
      fours[i + 2 * k + 1] = _mm256_shuffle_ps(pairs[i + k], pairs[i + k + 2], 0xee);
    }
  __m256 sum = _mm256_setzero_ps();
  for (int lane = 0; lane < 4; ++lane)
    sum = _mm256_add_ps(sum, _mm256_permute2f128_ps(fours[lane], fours[lane + 4], 0x20));
  for (int lane = 0; lane < 4; ++lane)
    sum = _mm256_add_ps(sum, _mm256_permute2f128_ps(fours[lane], fours[lane + 4], 0x31));
  return sum;
}

/// Sums of the offsets of neighbours, and of their products, in eight parts each.
struct MomentParts {
  __m256 x, y, z, xx, xy, xz, yy, yz, zz;

  GRASPD_AVX2 void add(__m256 dx, __m256 dy, __m256 dz) {
    x = _mm256_add_ps(x, dx);
    y = _mm256_add_ps(y, dy);
    z = _mm256_add_ps(z, dz);
    xx = _mm256_add_ps(xx, _mm256_mul_ps(dx, dx));
    xy = _mm256_add_ps(xy, _mm256_mul_ps(dx, dy));
    xz = _mm256_add_ps(xz, _mm256_mul_ps(dx, dz));
    yy = _mm256_add_ps(yy, _mm256_mul_ps(dy, dy));
    yz = _mm256_add_ps(yz, _mm256_mul_ps(dy, dz));
    zz = _mm256_add_ps(zz, _mm256_mul_ps(dz, dz));
  }
};

GRASPD_AVX2 inline void sum_parts(const float* x, const float* y, const float* z, const NeighborList& list,
                                  MomentParts& sum) {
  const __m256 px = _mm256_set1_ps(x[list.point]), py = _mm256_set1_ps(y[list.point]),
               pz = _mm256_set1_ps(z[list.point]);
  const auto offsets = [&](const float* v, __m256i i, __m256 origin) GRASPD_AVX2 {
    return _mm256_sub_ps(_mm256_i32gather_ps(v, i, sizeof(float)), origin);
  };
  const __m256 zero = _mm256_setzero_ps();
  sum = {zero, zero, zero, zero, zero, zero, zero, zero, zero};
  std::size_t from = 0;
  for (; from + 8 <= list.size; from += 8) {
    const __m256i i = load(list.indices + from);
    sum.add(offsets(x, i, px), offsets(y, i, py), offsets(z, i, pz));
  }
  if (from < list.size) {
    const __m256i i = load(list.indices + from);
    const __m256 valid = lanes_left(list.size - from);
    sum.add(_mm256_and_ps(valid, offsets(x, i, px)), _mm256_and_ps(valid, offsets(y, i, py)),
            _mm256_and_ps(valid, offsets(z, i, pz)));
  }
}

GRASPD_AVX2 void sum_moments(const float* x, const float* y, const float* z,
                             std::span<const NeighborList> lists, MomentLanes& out) {
  __m256 parts[9][kSolved];
  for (std::size_t k = 0; k < kSolved; ++k) {
    const bool is_there = k < lists.size();
    MomentParts sum;
    sum_parts(x, y, z, is_there ? lists[k] : NeighborList{}, sum);
    const __m256 all[9] = {sum.x, sum.y, sum.z, sum.xx, sum.xy, sum.xz, sum.yy, sum.yz, sum.zz};
    for (int m = 0; m < 9; ++m) parts[m][k] = all[m];
    out.count[k] = is_there ? static_cast<float>(lists[k].size) : 0.0f;
  }
  float* sums[9] = {out.x, out.y, out.z, out.xx, out.xy, out.xz, out.yy, out.yz, out.zz};
  for (int m = 0; m < 9; ++m) _mm256_storeu_ps(sums[m], sums_of_lanes(parts[m]));
}

GRASPD_AVX2 void extend_bounds(const float* v, std::size_t n, float& low, float& high) {
  __m256 lows = _mm256_set1_ps(low), highs = _mm256_set1_ps(high);
  std::size_t i = 0;
  for (; i + 8 <= n; i += 8) {
    const __m256 c = _mm256_loadu_ps(v + i);
    lows = _mm256_min_ps(c, lows);  // the second operand where one is NaN
    highs = _mm256_max_ps(c, highs);
  }
  alignas(32) float lanes[8];
  float unused = 0;
  _mm256_store_ps(lanes, lows);
  portable_kernels().extend_bounds(lanes, 8, low, unused);
  _mm256_store_ps(lanes, highs);
  portable_kernels().extend_bounds(lanes, 8, unused, high);
  portable_kernels().extend_bounds(v + i, n - i, low, high);
}

GRASPD_AVX2 void meet_rows(const RowLimits& limits, const CellRows& rows, std::int32_t* from,
                           std::int32_t* to) {
  __m256 least[4], most[4], slope[4];
  for (int k = 0; k < 4; ++k) {
    least[k] = _mm256_set1_ps(limits.least[k]);
    most[k] = _mm256_set1_ps(limits.most[k]);
    slope[k] = _mm256_set1_ps(limits.slope[k]);
  }
  const __m256 cell = _mm256_set1_ps(limits.cell_m), per_cell = _mm256_set1_ps(1 / limits.cell_m);
  const __m256i zero = _mm256_setzero_si256(), one = _mm256_set1_epi32(1);
  for (std::size_t i = 0; i < rows.size; i += 8) {
    const __m256 y =
        _mm256_mul_ps(_mm256_add_ps(_mm256_cvtepi32_ps(load(rows.y + i)), _mm256_set1_ps(0.5f)), cell);
    __m256 moved = _mm256_mul_ps(slope[0], y);
    __m256 x0 = _mm256_sub_ps(least[0], moved), x1 = _mm256_sub_ps(most[0], moved);
    for (int k = 1; k < 4; ++k) {
      moved = _mm256_mul_ps(slope[k], y);
      x0 = _mm256_max_ps(_mm256_sub_ps(least[k], moved), x0);
      x1 = _mm256_min_ps(_mm256_sub_ps(most[k], moved), x1);
    }
    const __m256i x = load(rows.x + i);
    const __m256i first = _mm256_sub_epi32(floor_to_int(_mm256_mul_ps(x0, per_cell)), x),
                  end = _mm256_sub_epi32(_mm256_add_epi32(floor_to_int(_mm256_mul_ps(x1, per_cell)), one), x);
    const __m256i none = _mm256_castps_si256(_mm256_cmp_ps(x0, x1, _CMP_GT_OQ));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(from + i), _mm256_max_epi32(zero, first));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to + i),
                        _mm256_andnot_si256(none, _mm256_min_epi32(load(rows.num_cells + i), end)));
  }
}

GRASPD_AVX2 inline __m256i cells_from_first(const float* v, __m256 per_cell, int min_cell) {
  return _mm256_sub_epi32(floor_to_int(_mm256_mul_ps(_mm256_loadu_ps(v), per_cell)),
                          _mm256_set1_epi32(min_cell));
}

GRASPD_AVX2 void number_cells(const CellGrid& grid, const float* x, const float* y, const float* z,
                              std::size_t n, std::uint32_t* out) {
  const __m256 per_cell = _mm256_set1_ps(grid.per_cell);
  const __m256i row = _mm256_set1_epi32(static_cast<int>(grid.row)),
                layer = _mm256_set1_epi32(static_cast<int>(grid.layer));
  std::size_t i = 0;
  for (; i + 8 <= n; i += 8) {
    const __m256i cx = cells_from_first(x + i, per_cell, grid.min_cell[0]),
                  cy = cells_from_first(y + i, per_cell, grid.min_cell[1]),
                  cz = cells_from_first(z + i, per_cell, grid.min_cell[2]);
    const __m256i cell =
        _mm256_add_epi32(_mm256_add_epi32(cx, _mm256_mullo_epi32(row, cy)), _mm256_mullo_epi32(layer, cz));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(out + i), cell);
  }
  portable_kernels().number_cells(grid, x + i, y + i, z + i, n - i, out + i);
}

}  // namespace

const PointKernels* avx2_kernels() {
  static constexpr PointKernels kKernels{
      test_workspace, copy_chosen,    keep_inside,   count_inside,   meet_rows,   keep_near,
      copy_inside,    sum_moments,    solve_planes,  count_on_plane, count_bent,  find_links,
      any_other,      list_above,     list_members,  list_unmarked,  sum_circle,  sum_profile,
      find_hiders,    sum_directions, extend_slopes, find_pixels,    first_few,   extend_bounds,
      number_cells,   count_changes,  write_runs,    count_cells,    write_cells, copy_at,
      set_means,      find_middles,   tag_band,      keep_depths,    select_band, select_own,
      extend_own,     mark_band};
  static const bool has_avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("popcnt");
  return has_avx2 ? &kKernels : nullptr;
}

}  // namespace graspd

#else

namespace graspd {

const PointKernels* avx2_kernels() {
  return nullptr;
}

}  // namespace graspd

#endif

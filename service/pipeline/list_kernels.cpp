// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Which of many points have something, and the first few of many values, in both forms.
#include <algorithm>
#include <bit>
#include <limits>

#include "service/pipeline/avx2_lanes.hpp"
#include "service/pipeline/surface_kernels.hpp"

namespace graspd {
namespace portable {

std::size_t list_above(const std::int32_t* values, std::int32_t limit, const std::uint32_t* indices,
                       std::size_t n, std::uint32_t* out) {
  std::size_t num = 0;
  for (std::size_t k = 0; k < n; ++k) {
    out[num] = indices[k];
    num += values[indices[k]] > limit ? 1 : 0;
  }
  return num;
}

std::size_t list_members(const std::int32_t* values, std::size_t n, std::uint32_t* out) {
  std::size_t num = 0;
  for (std::size_t i = 0; i < n; ++i) {
    out[num] = static_cast<std::uint32_t>(i);
    num += values[i] >= 0 ? 1 : 0;
  }
  return num;
}

std::size_t list_unmarked(const std::uint8_t* marks, std::size_t n, std::uint32_t* out) {
  std::size_t num = 0;
  for (std::size_t i = 0; i < n; ++i) {
    out[num] = static_cast<std::uint32_t>(i);
    num += marks[i] == 0 ? 1 : 0;
  }
  return num;
}

void first_few(const float* v, std::size_t n, bool largest, float (&out)[kFew]) {
  // The largest are the smallest with the sign changed.
  const float sign = largest ? -1.0f : 1.0f;
  std::fill_n(out, kFew, std::numeric_limits<float>::infinity());
  for (std::size_t i = 0; i < n; ++i) {
    const float value = sign * v[i];
    if (!(value < out[kFew - 1])) continue;
    std::size_t k = kFew - 1;
    for (; k > 0 && value < out[k - 1]; --k) out[k] = out[k - 1];
    out[k] = value;
  }
  for (float& value : out) value *= sign;
}

}  // namespace portable

#if defined(__x86_64__)

namespace avx2 {
namespace {

/// In each lane the smallest values so far, ascending.
struct Smallest {
  __m256 of[kFew];

  GRASPD_AVX2 void add(__m256 v) {
    for (__m256& smallest : of) {
      const __m256 larger = _mm256_max_ps(smallest, v);
      smallest = _mm256_min_ps(smallest, v);
      v = larger;
    }
  }

  /// Adds the lanes of others, which are ascending, too: the smaller ones of one end to end with the other
  /// are the smallest of both, and rise and fall.
  GRASPD_AVX2 void add(const Smallest& others) {
    for (std::size_t k = 0; k < kFew; ++k) of[k] = _mm256_min_ps(of[k], others.of[kFew - 1 - k]);
    for (std::size_t step = kFew / 2; step > 0; step /= 2)
      for (std::size_t k = 0; k < kFew; ++k) {
        if ((k & step) != 0) continue;
        const __m256 larger = _mm256_max_ps(of[k], of[k + step]);
        of[k] = _mm256_min_ps(of[k], of[k + step]);
        of[k + step] = larger;
      }
  }
};

}  // namespace

GRASPD_AVX2 std::size_t list_above(const std::int32_t* values, std::int32_t limit,
                                   const std::uint32_t* indices, std::size_t n, std::uint32_t* out) {
  const __m256i most = _mm256_set1_epi32(limit);
  std::size_t num = 0;
  for (std::size_t k = 0; k < n; k += 8) {
    const __m256i v = _mm256_i32gather_epi32(values, load(indices + k), sizeof(std::int32_t));
    const unsigned above =
        valid_lanes(_mm256_movemask_ps(_mm256_castsi256_ps(_mm256_cmpgt_epi32(v, most))), k, n);
    if (above == 0) continue;
    store_index(out + num, indices + k, lanes_of(above));
    num += static_cast<std::size_t>(std::popcount(above));
  }
  return num;
}

GRASPD_AVX2 inline std::size_t list_lanes(unsigned mask, __m256i positions, std::uint32_t* out) {
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(out),
                      _mm256_permutevar8x32_epi32(positions, lanes_of(mask)));
  return static_cast<std::size_t>(std::popcount(mask));
}

GRASPD_AVX2 std::size_t list_members(const std::int32_t* values, std::size_t n, std::uint32_t* out) {
  const __m256i eight = _mm256_set1_epi32(8);
  __m256i positions = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  std::size_t num = 0, i = 0;
  for (; i + 8 <= n; i += 8, positions = _mm256_add_epi32(positions, eight))
    if (const unsigned others =
            static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(load(values + i))));
        others != 0xff)
      num += list_lanes(others ^ 0xff, positions, out + num);
  for (; i < n; ++i)
    if (values[i] >= 0) out[num++] = static_cast<std::uint32_t>(i);
  return num;
}

GRASPD_AVX2 std::size_t list_unmarked(const std::uint8_t* marks, std::size_t n, std::uint32_t* out) {
  const __m256i eight = _mm256_set1_epi32(8), zero = _mm256_setzero_si256();
  std::size_t num = 0, i = 0;
  for (; i + 32 <= n; i += 32) {
    const __m256i unmarked = _mm256_cmpeq_epi8(load(marks + i), zero);
    auto mask = static_cast<unsigned>(_mm256_movemask_epi8(unmarked));
    __m256i positions =
        _mm256_add_epi32(_mm256_set1_epi32(static_cast<int>(i)), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
    for (; mask != 0; mask >>= 8, positions = _mm256_add_epi32(positions, eight))
      num += list_lanes(mask & 0xff, positions, out + num);
  }
  for (; i < n; ++i)
    if (marks[i] == 0) out[num++] = static_cast<std::uint32_t>(i);
  return num;
}

GRASPD_AVX2 void first_few(const float* v, std::size_t n, bool largest, float (&out)[kFew]) {
  const __m256 infinity = _mm256_set1_ps(std::numeric_limits<float>::infinity()),
               sign = _mm256_set1_ps(largest ? -0.0f : 0.0f);
  Smallest smallest{{infinity, infinity, infinity, infinity}};
  std::size_t i = 0;
  for (; i + 8 <= n; i += 8) smallest.add(_mm256_xor_ps(_mm256_loadu_ps(v + i), sign));
  if (i < n) {
    const __m256 lanes = lanes_left(n - i);
    const __m256 rest = _mm256_maskload_ps(v + i, _mm256_castps_si256(lanes));
    smallest.add(_mm256_blendv_ps(infinity, _mm256_xor_ps(rest, sign), lanes));
  }
  Smallest others;
  for (std::size_t k = 0; k < kFew; ++k)
    others.of[k] = _mm256_permute2f128_ps(smallest.of[k], smallest.of[k], 1);
  smallest.add(others);
  for (std::size_t k = 0; k < kFew; ++k) others.of[k] = _mm256_permute_ps(smallest.of[k], 0b01001110);
  smallest.add(others);
  for (std::size_t k = 0; k < kFew; ++k) others.of[k] = _mm256_permute_ps(smallest.of[k], 0b10110001);
  smallest.add(others);
  for (std::size_t k = 0; k < kFew; ++k) out[k] = _mm256_cvtss_f32(_mm256_xor_ps(smallest.of[k], sign));
}

}  // namespace avx2

#endif

}  // namespace graspd

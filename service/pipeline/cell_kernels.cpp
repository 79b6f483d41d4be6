// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What cells' points are put together with, in both forms: eight cells at a time, each of them in its own
// lane. Products and sums stay separate operations, as in point_kernels_avx2.cpp.
#include "service/pipeline/avx2_lanes.hpp"
#include "service/pipeline/surface_kernels.hpp"

namespace graspd {
namespace portable {
namespace {

/// The cells from c on.
CellPoints rest(CellPoints cells, std::size_t c) {
  cells.starts += c;
  cells.num_cells -= c;
  return cells;
}

}  // namespace

void set_means(const CellPoints& cells, float* x, float* y, float* z) {
  for (std::size_t c = 0; c < cells.num_cells; ++c) {
    const std::uint32_t *index = cells.index + cells.starts[c], *end = cells.index + cells.starts[c + 1];
    const auto n = static_cast<float>(end - index);
    const float x0 = cells.x[*index], y0 = cells.y[*index], z0 = cells.z[*index];
    float sum_x = 0, sum_y = 0, sum_z = 0;
    while (++index != end) {
      sum_x += cells.x[*index] - x0;
      sum_y += cells.y[*index] - y0;
      sum_z += cells.z[*index] - z0;
    }
    x[c] = x0 + sum_x / n;
    y[c] = y0 + sum_y / n;
    z[c] = z0 + sum_z / n;
  }
}

void find_middles(const CellPoints& cells, std::uint32_t* out) {
  for (std::size_t c = 0; c < cells.num_cells; ++c) {
    const std::uint32_t *begin = cells.index + cells.starts[c], *end = cells.index + cells.starts[c + 1];
    const auto n = static_cast<float>(end - begin);
    float x = 0, y = 0, z = 0;
    for (const std::uint32_t* index = begin; index != end; ++index) {
      x += cells.x[*index];
      y += cells.y[*index];
      z += cells.z[*index];
    }
    x /= n;
    y /= n;
    z /= n;
    const auto squared = [&](std::uint32_t i) {
      const float dx = cells.x[i] - x, dy = cells.y[i] - y, dz = cells.z[i] - z;
      return dx * dx + (dy * dy + dz * dz);
    };
    out[c] = *begin;
    float least = squared(*begin);
    for (const std::uint32_t* index = begin + 1; index != end; ++index)
      if (const float distance = squared(*index); distance < least) {
        least = distance;
        out[c] = *index;
      }
  }
}

}  // namespace portable

#if defined(__x86_64__)

namespace avx2 {
namespace {

/// Eight cells' points, one of each at a time.
class CellLanes {
 public:
  GRASPD_AVX2 CellLanes(const CellPoints& cells, std::size_t c)
      : cells_(cells),
        start_(load(cells.starts + c)),
        size_(_mm256_sub_epi32(load(cells.starts + c + 1), start_)),
        first_(_mm256_i32gather_epi32(indices(), start_, sizeof(std::uint32_t))) {}

  /// The lanes that have a j-th point.
  [[nodiscard]] GRASPD_AVX2 __m256i have(int j) const {
    return _mm256_cmpgt_epi32(size_, _mm256_set1_epi32(j));
  }
  /// Its index; that of the first point in the other lanes.
  [[nodiscard]] GRASPD_AVX2 __m256i at(int j, __m256i lanes) const {
    return _mm256_mask_i32gather_epi32(first_, indices(), _mm256_add_epi32(start_, _mm256_set1_epi32(j)),
                                       lanes, sizeof(std::uint32_t));
  }
  [[nodiscard]] GRASPD_AVX2 __m256i first() const { return first_; }
  [[nodiscard]] GRASPD_AVX2 __m256 size() const { return _mm256_cvtepi32_ps(size_); }

  [[nodiscard]] GRASPD_AVX2 __m256 x(__m256i i) const { return _mm256_i32gather_ps(cells_.x, i, 4); }
  [[nodiscard]] GRASPD_AVX2 __m256 y(__m256i i) const { return _mm256_i32gather_ps(cells_.y, i, 4); }
  [[nodiscard]] GRASPD_AVX2 __m256 z(__m256i i) const { return _mm256_i32gather_ps(cells_.z, i, 4); }

 private:
  [[nodiscard]] GRASPD_AVX2 const int* indices() const { return reinterpret_cast<const int*>(cells_.index); }

  const CellPoints& cells_;
  __m256i start_, size_, first_;
};

GRASPD_AVX2 inline bool is_none(__m256i lanes) {
  return _mm256_testz_si256(lanes, lanes) != 0;
}

}  // namespace

GRASPD_AVX2 void set_means(const CellPoints& cells, float* x, float* y, float* z) {
  std::size_t c = 0;
  for (; c + 8 <= cells.num_cells; c += 8) {
    const CellLanes lanes(cells, c);
    const __m256 x0 = lanes.x(lanes.first()), y0 = lanes.y(lanes.first()), z0 = lanes.z(lanes.first());
    __m256 sum_x = _mm256_setzero_ps(), sum_y = sum_x, sum_z = sum_x;
    __m256i have = lanes.have(1);
    for (int j = 1; !is_none(have); have = lanes.have(++j)) {
      const __m256i i = lanes.at(j, have);  // the first point again adds nothing
      sum_x = _mm256_add_ps(sum_x, _mm256_sub_ps(lanes.x(i), x0));
      sum_y = _mm256_add_ps(sum_y, _mm256_sub_ps(lanes.y(i), y0));
      sum_z = _mm256_add_ps(sum_z, _mm256_sub_ps(lanes.z(i), z0));
    }
    const __m256 n = lanes.size();
    _mm256_storeu_ps(x + c, _mm256_add_ps(x0, _mm256_div_ps(sum_x, n)));
    _mm256_storeu_ps(y + c, _mm256_add_ps(y0, _mm256_div_ps(sum_y, n)));
    _mm256_storeu_ps(z + c, _mm256_add_ps(z0, _mm256_div_ps(sum_z, n)));
  }
  portable::set_means(portable::rest(cells, c), x + c, y + c, z + c);
}

GRASPD_AVX2 void find_middles(const CellPoints& cells, std::uint32_t* out) {
  std::size_t c = 0;
  for (; c + 8 <= cells.num_cells; c += 8) {
    const CellLanes lanes(cells, c);
    __m256 x = lanes.x(lanes.first()), y = lanes.y(lanes.first()), z = lanes.z(lanes.first());
    __m256i have = lanes.have(1), nearest = lanes.first();
    if (!is_none(have)) {
      for (int j = 1; !is_none(have); have = lanes.have(++j)) {
        const __m256i i = lanes.at(j, have);
        const __m256 mask = _mm256_castsi256_ps(have);
        x = _mm256_add_ps(x, _mm256_and_ps(mask, lanes.x(i)));
        y = _mm256_add_ps(y, _mm256_and_ps(mask, lanes.y(i)));
        z = _mm256_add_ps(z, _mm256_and_ps(mask, lanes.z(i)));
      }
      const __m256 n = lanes.size();
      x = _mm256_div_ps(x, n);
      y = _mm256_div_ps(y, n);
      z = _mm256_div_ps(z, n);
      const auto squared = [&](__m256i i) GRASPD_AVX2 {
        const __m256 dx = _mm256_sub_ps(lanes.x(i), x), dy = _mm256_sub_ps(lanes.y(i), y),
                     dz = _mm256_sub_ps(lanes.z(i), z);
        return _mm256_add_ps(_mm256_mul_ps(dx, dx),
                             _mm256_add_ps(_mm256_mul_ps(dy, dy), _mm256_mul_ps(dz, dz)));
      };
      __m256 least = squared(nearest);
      have = lanes.have(1);
      for (int j = 1; !is_none(have); have = lanes.have(++j)) {
        const __m256i i = lanes.at(j, have);  // the first point again is not nearer than itself
        const __m256 distance = squared(i), is_nearer = _mm256_cmp_ps(distance, least, _CMP_LT_OQ);
        least = _mm256_blendv_ps(least, distance, is_nearer);
        nearest = _mm256_blendv_epi8(nearest, i, _mm256_castps_si256(is_nearer));
      }
    }
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(out + c), nearest);
  }
  portable::find_middles(portable::rest(cells, c), out + c);
}

}  // namespace avx2

#endif

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What a depth image is rendered with, in both forms. Products and sums stay separate operations, as in
// point_kernels_avx2.cpp.
#include <algorithm>
#include <cmath>

#include "service/pipeline/avx2_lanes.hpp"
#include "service/pipeline/surface_kernels.hpp"

namespace graspd {
namespace portable {
namespace {

struct ViewPoint {
  float x, y, z;
};

/// Point k along the axes of the view.
ViewPoint see(const ViewImage& view, const PointRange& points, std::size_t k) {
  const auto& m = view.axes;
  const float dx = points.x[k] - view.origin[0], dy = points.y[k] - view.origin[1],
              dz = points.z[k] - view.origin[2];
  return {m[0][0] * dx + m[0][1] * dy + m[0][2] * dz, m[1][0] * dx + m[1][1] * dy + m[1][2] * dz,
          m[2][0] * dx + m[2][1] * dy + m[2][2] * dz};
}

}  // namespace

void sum_directions(const ViewImage& view, const PointRange& points, DirectionSums& sums) {
  for (std::size_t k = 0; k < points.size; ++k) {
    const float x = points.x[k] - view.origin[0], y = points.y[k] - view.origin[1],
                z = points.z[k] - view.origin[2], squared = x * x + y * y + z * z;
    const float per_length = squared > 0 ? 1 / std::sqrt(squared) : 0;
    sums.x[k % 8] += x * per_length;
    sums.y[k % 8] += y * per_length;
    sums.z[k % 8] += z * per_length;
  }
}

void extend_slopes(const ViewImage& view, const PointRange& points, SlopeBounds& bounds) {
  for (std::size_t k = 0; k < points.size; ++k) {
    const ViewPoint p = see(view, points, k);
    if (!(p.z > 0)) continue;
    bounds.left = std::min(bounds.left, p.x / p.z);
    bounds.right = std::max(bounds.right, p.x / p.z);
    bounds.top = std::min(bounds.top, p.y / p.z);
    bounds.bottom = std::max(bounds.bottom, p.y / p.z);
  }
}

void find_pixels(const ViewImage& view, const PointRange& points, std::int32_t* pixels, float* depths) {
  const auto width = static_cast<float>(view.width), height = static_cast<float>(view.height);
  for (std::size_t k = 0; k < points.size; ++k) {
    const ViewPoint p = see(view, points, k);
    const float u = view.focal[0] * p.x / p.z + view.center[0] + 0.5f,
                v = view.focal[1] * p.y / p.z + view.center[1] + 0.5f;
    const bool is_inside = p.z > 0 && u >= 0 && v >= 0 && u < width && v < height;
    pixels[k] = is_inside ? static_cast<std::int32_t>(v) * view.width + static_cast<std::int32_t>(u) : -1;
    depths[k] = p.z;
  }
}

}  // namespace portable

#if defined(__x86_64__)

namespace avx2 {
namespace {

/// What is left of points from k on.
PointRange rest(const PointRange& points, std::size_t k) {
  return {points.x + k, points.y + k, points.z + k, nullptr, points.size - k};
}

/// Eight points, from the view's origin.
struct Offsets {
  __m256 x, y, z;
};

GRASPD_AVX2 inline Offsets offsets(const ViewImage& view, const PointRange& points, std::size_t k) {
  return {_mm256_sub_ps(_mm256_loadu_ps(points.x + k), _mm256_set1_ps(view.origin[0])),
          _mm256_sub_ps(_mm256_loadu_ps(points.y + k), _mm256_set1_ps(view.origin[1])),
          _mm256_sub_ps(_mm256_loadu_ps(points.z + k), _mm256_set1_ps(view.origin[2]))};
}

GRASPD_AVX2 inline __m256 along(const float (&axis)[3], const Offsets& d) {
  const __m256 xy =
      _mm256_add_ps(_mm256_mul_ps(_mm256_set1_ps(axis[0]), d.x), _mm256_mul_ps(_mm256_set1_ps(axis[1]), d.y));
  return _mm256_add_ps(xy, _mm256_mul_ps(_mm256_set1_ps(axis[2]), d.z));
}

GRASPD_AVX2 inline void add_to(float (&sums)[8], __m256 v) {
  _mm256_storeu_ps(sums, _mm256_add_ps(_mm256_loadu_ps(sums), v));
}

}  // namespace

GRASPD_AVX2 void sum_directions(const ViewImage& view, const PointRange& points, DirectionSums& sums) {
  const __m256 zero = _mm256_setzero_ps(), one = _mm256_set1_ps(1);
  std::size_t k = 0;
  for (; k + 8 <= points.size; k += 8) {
    const Offsets d = offsets(view, points, k);
    const __m256 xy = _mm256_add_ps(_mm256_mul_ps(d.x, d.x), _mm256_mul_ps(d.y, d.y)),
                 squared = _mm256_add_ps(xy, _mm256_mul_ps(d.z, d.z));
    const __m256 per_length =
        _mm256_and_ps(_mm256_cmp_ps(squared, zero, _CMP_GT_OQ), _mm256_div_ps(one, _mm256_sqrt_ps(squared)));
    add_to(sums.x, _mm256_mul_ps(d.x, per_length));
    add_to(sums.y, _mm256_mul_ps(d.y, per_length));
    add_to(sums.z, _mm256_mul_ps(d.z, per_length));
  }
  portable::sum_directions(view, rest(points, k), sums);
}

GRASPD_AVX2 void extend_slopes(const ViewImage& view, const PointRange& points, SlopeBounds& bounds) {
  __m256 left = _mm256_set1_ps(bounds.left), right = _mm256_set1_ps(bounds.right),
         top = _mm256_set1_ps(bounds.top), bottom = _mm256_set1_ps(bounds.bottom);
  std::size_t k = 0;
  for (; k + 8 <= points.size; k += 8) {
    const Offsets d = offsets(view, points, k);
    const __m256 z = along(view.axes[2], d);
    // All bits set is no number, of which smallest and largest take the second operand.
    const __m256 behind = _mm256_cmp_ps(z, _mm256_setzero_ps(), _CMP_NGT_UQ);
    const __m256 u = _mm256_or_ps(behind, _mm256_div_ps(along(view.axes[0], d), z)),
                 v = _mm256_or_ps(behind, _mm256_div_ps(along(view.axes[1], d), z));
    left = _mm256_min_ps(u, left);
    right = _mm256_max_ps(u, right);
    top = _mm256_min_ps(v, top);
    bottom = _mm256_max_ps(v, bottom);
  }
  alignas(32) float lanes[4][8];
  _mm256_store_ps(lanes[0], left);
  _mm256_store_ps(lanes[1], right);
  _mm256_store_ps(lanes[2], top);
  _mm256_store_ps(lanes[3], bottom);
  bounds = {*std::ranges::min_element(lanes[0]), *std::ranges::max_element(lanes[1]),
            *std::ranges::min_element(lanes[2]), *std::ranges::max_element(lanes[3])};
  portable::extend_slopes(view, rest(points, k), bounds);
}

GRASPD_AVX2 void find_pixels(const ViewImage& view, const PointRange& points, std::int32_t* pixels,
                             float* depths) {
  const __m256 half = _mm256_set1_ps(0.5f), zero = _mm256_setzero_ps();
  const auto place = [&](int axis, __m256 v, __m256 z) GRASPD_AVX2 {
    const __m256 scaled = _mm256_div_ps(_mm256_mul_ps(_mm256_set1_ps(view.focal[axis]), v), z);
    return _mm256_add_ps(_mm256_add_ps(scaled, _mm256_set1_ps(view.center[axis])), half);
  };
  const auto within = [&](__m256 v, std::int32_t size) GRASPD_AVX2 {
    return _mm256_and_ps(_mm256_cmp_ps(v, zero, _CMP_GE_OQ),
                         _mm256_cmp_ps(v, _mm256_set1_ps(static_cast<float>(size)), _CMP_LT_OQ));
  };
  std::size_t k = 0;
  for (; k + 8 <= points.size; k += 8) {
    const Offsets d = offsets(view, points, k);
    const __m256 z = along(view.axes[2], d), u = place(0, along(view.axes[0], d), z),
                 v = place(1, along(view.axes[1], d), z);
    const __m256 inside = _mm256_and_ps(_mm256_cmp_ps(z, zero, _CMP_GT_OQ),
                                        _mm256_and_ps(within(u, view.width), within(v, view.height)));
    const __m256i pixel = _mm256_add_epi32(
        _mm256_mullo_epi32(_mm256_cvttps_epi32(v), _mm256_set1_epi32(view.width)), _mm256_cvttps_epi32(u));
    const __m256i pixel_or_none =
        _mm256_blendv_epi8(_mm256_set1_epi32(-1), pixel, _mm256_castps_si256(inside));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(pixels + k), pixel_or_none);
    _mm256_storeu_ps(depths + k, z);
  }
  portable::find_pixels(view, rest(points, k), pixels + k, depths + k);
}

}  // namespace avx2

#endif

}  // namespace graspd

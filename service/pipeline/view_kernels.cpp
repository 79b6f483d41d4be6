// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What a depth image is rendered with, in both forms. Products and sums stay separate operations, as in
// point_kernels_avx2.cpp.
#include "service/pipeline/avx2_lanes.hpp"
#include "service/pipeline/surface_kernels.hpp"

namespace graspd {
namespace portable {

void see_points(const ViewImage& view, const PointRange& points, const ViewPoints& out) {
  const auto& m = view.axes;
  const float ox = view.origin[0], oy = view.origin[1], oz = view.origin[2];
  for (std::size_t k = 0; k < points.size; ++k) {
    const float dx = points.x[k] - ox, dy = points.y[k] - oy, dz = points.z[k] - oz;
    out.x[k] = m[0][0] * dx + m[0][1] * dy + m[0][2] * dz;
    out.y[k] = m[1][0] * dx + m[1][1] * dy + m[1][2] * dz;
    out.z[k] = m[2][0] * dx + m[2][1] * dy + m[2][2] * dz;
  }
}

void find_pixels(const ViewImage& view, const ViewPoints& points, std::size_t n, std::int32_t* out) {
  const auto width = static_cast<float>(view.width), height = static_cast<float>(view.height);
  for (std::size_t k = 0; k < n; ++k) {
    const float u = view.focal[0] * points.x[k] / points.z[k] + view.center[0] + 0.5f,
                v = view.focal[1] * points.y[k] / points.z[k] + view.center[1] + 0.5f;
    const bool is_inside = points.z[k] > 0 && u >= 0 && v >= 0 && u < width && v < height;
    out[k] = is_inside ? static_cast<std::int32_t>(v) * view.width + static_cast<std::int32_t>(u) : -1;
  }
}

}  // namespace portable

#if defined(__x86_64__)

namespace avx2 {

GRASPD_AVX2 void see_points(const ViewImage& view, const PointRange& points, const ViewPoints& out) {
  __m256 m[3][3], origin[3];
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) m[i][j] = _mm256_set1_ps(view.axes[i][j]);
    origin[i] = _mm256_set1_ps(view.origin[i]);
  }
  float* to[3] = {out.x, out.y, out.z};
  std::size_t k = 0;
  for (; k + 8 <= points.size; k += 8) {
    const __m256 dx = _mm256_sub_ps(_mm256_loadu_ps(points.x + k), origin[0]),
                 dy = _mm256_sub_ps(_mm256_loadu_ps(points.y + k), origin[1]),
                 dz = _mm256_sub_ps(_mm256_loadu_ps(points.z + k), origin[2]);
    for (int i = 0; i < 3; ++i) {
      const __m256 xy = _mm256_add_ps(_mm256_mul_ps(m[i][0], dx), _mm256_mul_ps(m[i][1], dy));
      _mm256_storeu_ps(to[i] + k, _mm256_add_ps(xy, _mm256_mul_ps(m[i][2], dz)));
    }
  }
  portable::see_points(view, {points.x + k, points.y + k, points.z + k, nullptr, points.size - k},
                       {out.x + k, out.y + k, out.z + k});
}

GRASPD_AVX2 void find_pixels(const ViewImage& view, const ViewPoints& points, std::size_t n,
                             std::int32_t* out) {
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
  for (; k + 8 <= n; k += 8) {
    const __m256 z = _mm256_loadu_ps(points.z + k), u = place(0, _mm256_loadu_ps(points.x + k), z),
                 v = place(1, _mm256_loadu_ps(points.y + k), z);
    const __m256 inside = _mm256_and_ps(_mm256_cmp_ps(z, zero, _CMP_GT_OQ),
                                        _mm256_and_ps(within(u, view.width), within(v, view.height)));
    const __m256i pixel = _mm256_add_epi32(
        _mm256_mullo_epi32(_mm256_cvttps_epi32(v), _mm256_set1_epi32(view.width)), _mm256_cvttps_epi32(u));
    const __m256i pixel_or_none =
        _mm256_blendv_epi8(_mm256_set1_epi32(-1), pixel, _mm256_castps_si256(inside));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(out + k), pixel_or_none);
  }
  portable::find_pixels(view, {points.x + k, points.y + k, points.z + k}, n - k, out + k);
}

}  // namespace avx2

#endif

}  // namespace graspd

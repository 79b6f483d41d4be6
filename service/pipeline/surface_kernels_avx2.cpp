// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What surfaces are found with, eight points or neighbours at a time. Products and sums stay separate
// operations, as in point_kernels_avx2.cpp.
#include "service/pipeline/avx2_lanes.hpp"

#if defined(__x86_64__)
#include <numeric>

namespace graspd::avx2 {
namespace {

/// Of eight symmetric matrices, or of the minors of one.
struct Matrices {
  __m256 xx, xy, xz, yy, yz, zz;
};

GRASPD_AVX2 inline __m256 mul(__m256 a, __m256 b) {
  return _mm256_mul_ps(a, b);
}

GRASPD_AVX2 inline __m256 within(__m256 v, __m256 low, __m256 high) {
  return _mm256_and_ps(_mm256_cmp_ps(v, low, _CMP_GE_OQ), _mm256_cmp_ps(v, high, _CMP_LE_OQ));
}

/// a b - c d
GRASPD_AVX2 inline __m256 minor(__m256 a, __m256 b, __m256 c, __m256 d) {
  return _mm256_sub_ps(mul(a, b), mul(c, d));
}

/// Divided by their traces; all zero when there is no extent.
GRASPD_AVX2 inline Matrices covariances(const MomentLanes& m) {
  const __m256 one = _mm256_set1_ps(1), count = _mm256_loadu_ps(m.count),
               per = _mm256_div_ps(one, _mm256_max_ps(count, one));
  const __m256 x = _mm256_loadu_ps(m.x), y = _mm256_loadu_ps(m.y), z = _mm256_loadu_ps(m.z);
  const auto central = [per](const float* products, __m256 a, __m256 b) GRASPD_AVX2 {
    return _mm256_sub_ps(_mm256_loadu_ps(products), mul(mul(a, b), per));
  };
  const Matrices c{central(m.xx, x, x), central(m.xy, x, y), central(m.xz, x, z),
                   central(m.yy, y, y), central(m.yz, y, z), central(m.zz, z, z)};
  const __m256 trace = _mm256_add_ps(_mm256_add_ps(c.xx, c.yy), c.zz);
  const __m256 has_extent = _mm256_and_ps(_mm256_cmp_ps(count, _mm256_set1_ps(3), _CMP_GE_OQ),
                                          _mm256_cmp_ps(trace, _mm256_set1_ps(1e-20f), _CMP_GT_OQ));
  const __m256 scale = _mm256_and_ps(has_extent, _mm256_div_ps(one, trace));
  return {mul(c.xx, scale), mul(c.xy, scale), mul(c.xz, scale),
          mul(c.yy, scale), mul(c.yz, scale), mul(c.zz, scale)};
}

GRASPD_AVX2 inline __m256 sum_of_minors(const Matrices& c) {
  __m256 sum = minor(c.xx, c.yy, c.xy, c.xy);
  sum = _mm256_sub_ps(_mm256_add_ps(sum, mul(c.xx, c.zz)), mul(c.xz, c.xz));
  return _mm256_sub_ps(_mm256_add_ps(sum, mul(c.yy, c.zz)), mul(c.yz, c.yz));
}

/// The operands of minimum and maximum are in the order that keeps NaN, as the portable form does.
GRASPD_AVX2 inline __m256 smallest_eigenvalues(const Matrices& c, __m256 minors) {
  const __m256 det = _mm256_add_ps(
      _mm256_sub_ps(mul(c.xx, minor(c.yy, c.zz, c.yz, c.yz)), mul(c.xy, minor(c.xy, c.zz, c.yz, c.xz))),
      mul(c.xz, minor(c.xy, c.yz, c.yy, c.xz)));
  const __m256 zero = _mm256_setzero_ps(), one = _mm256_set1_ps(1), two = _mm256_set1_ps(2),
               three = _mm256_set1_ps(3), third = _mm256_set1_ps(1.0f / 3.0f), least = _mm256_set1_ps(1e-12f);
  __m256 t = zero;
  for (int step = 0; step < 8; ++step) {
    const __m256 value = _mm256_sub_ps(mul(_mm256_add_ps(mul(_mm256_sub_ps(t, one), t), minors), t), det);
    const __m256 slope = _mm256_add_ps(mul(_mm256_sub_ps(mul(three, t), two), t), minors);
    t = _mm256_sub_ps(t, _mm256_div_ps(value, _mm256_max_ps(least, slope)));
    t = _mm256_min_ps(third, _mm256_max_ps(zero, t));
  }
  return t;
}

struct Vectors {
  __m256 x, y, z;

  [[nodiscard]] GRASPD_AVX2 __m256 squared() const {
    return _mm256_add_ps(_mm256_add_ps(mul(x, x), mul(y, y)), mul(z, z));
  }
  [[nodiscard]] GRASPD_AVX2 __m256 dot(const float* u, const float* v, const float* w) const {
    return _mm256_add_ps(_mm256_add_ps(mul(x, _mm256_loadu_ps(u)), mul(y, _mm256_loadu_ps(v))),
                         mul(z, _mm256_loadu_ps(w)));
  }
  /// The other ones in the lanes that are set.
  [[nodiscard]] GRASPD_AVX2 Vectors blended(const Vectors& other, __m256 lanes) const {
    return {_mm256_blendv_ps(x, other.x, lanes), _mm256_blendv_ps(y, other.y, lanes),
            _mm256_blendv_ps(z, other.z, lanes)};
  }
};

GRASPD_AVX2 inline __m256 cosines(const NormalArrays& normals, const Vectors& n, __m256i i) {
  const __m256 x = _mm256_i32gather_ps(normals.x, i, sizeof(float)),
               y = _mm256_i32gather_ps(normals.y, i, sizeof(float)),
               z = _mm256_i32gather_ps(normals.z, i, sizeof(float));
  return _mm256_add_ps(_mm256_add_ps(mul(n.x, x), mul(n.y, y)), mul(n.z, z));
}

GRASPD_AVX2 inline Vectors normal_of(const NormalArrays& normals, std::uint32_t s) {
  return {_mm256_set1_ps(normals.x[s]), _mm256_set1_ps(normals.y[s]), _mm256_set1_ps(normals.z[s])};
}

GRASPD_AVX2 inline unsigned mask_of(__m256 lanes) {
  return static_cast<unsigned>(_mm256_movemask_ps(lanes));
}

}  // namespace

GRASPD_AVX2 std::size_t keep_near(const float (&p)[3], float distance_squared, const PointRange& points,
                                  std::span<const PointSpan> spans, std::uint32_t* out) {
  const __m256 px = _mm256_set1_ps(p[0]), py = _mm256_set1_ps(p[1]), pz = _mm256_set1_ps(p[2]),
               most = _mm256_set1_ps(distance_squared);
  const auto near = [&](std::size_t k) GRASPD_AVX2 {
    const Vectors offset{_mm256_sub_ps(px, _mm256_loadu_ps(points.x + k)),
                         _mm256_sub_ps(py, _mm256_loadu_ps(points.y + k)),
                         _mm256_sub_ps(pz, _mm256_loadu_ps(points.z + k))};
    return mask_of(_mm256_cmp_ps(offset.squared(), most, _CMP_LE_OQ));
  };
  std::size_t n = 0;
  for (const PointSpan& span : spans) {
    std::size_t k = span.begin;
    for (; k + 8 <= span.end; k += 8) {
      const unsigned mask = near(k);
      store_index(out + n, points.index + k, lanes_of(mask));
      n += static_cast<std::size_t>(std::popcount(mask));
    }
    if (k == span.end) continue;
    const unsigned mask = near(k) & first_lanes(span.end - k);
    store_index(out + n, points.index + k, lanes_of(mask));
    n += static_cast<std::size_t>(std::popcount(mask));
  }
  return n;
}

GRASPD_AVX2 std::size_t copy_inside(const float (&min)[3], const float (&max)[3], const PointRange& points,
                                    std::span<const PointSpan> spans, const LocalOutput& out) {
  const Vectors low{_mm256_set1_ps(min[0]), _mm256_set1_ps(min[1]), _mm256_set1_ps(min[2])},
      high{_mm256_set1_ps(max[0]), _mm256_set1_ps(max[1]), _mm256_set1_ps(max[2])};
  std::size_t n = 0;
  for (const PointSpan& span : spans)
    for (std::size_t k = span.begin; k < span.end; k += 8) {
      const __m256 x = _mm256_loadu_ps(points.x + k), y = _mm256_loadu_ps(points.y + k),
                   z = _mm256_loadu_ps(points.z + k);
      const __m256 inside = _mm256_and_ps(within(x, low.x, high.x),
                                          _mm256_and_ps(within(y, low.y, high.y), within(z, low.z, high.z)));
      const unsigned mask = valid_lanes(_mm256_movemask_ps(inside), k, span.end);
      if (mask == 0) continue;
      const __m256i lanes = lanes_of(mask);
      store(out.a + n, x, lanes);
      store(out.f + n, y, lanes);
      store(out.z + n, z, lanes);
      store_index(out.index + n, points.index + k, lanes);
      n += static_cast<std::size_t>(std::popcount(mask));
    }
  return n;
}

GRASPD_AVX2 int count_on_plane(const PlaneTest& test, const PlaneSample& sample) {
  const Vectors normal{_mm256_set1_ps(test.normal[0]), _mm256_set1_ps(test.normal[1]),
                       _mm256_set1_ps(test.normal[2])};
  const __m256 offset = _mm256_set1_ps(test.offset), thickness = _mm256_set1_ps(test.thickness),
               least = _mm256_set1_ps(test.min_cosine), sign = _mm256_set1_ps(-0.0f);
  const NormalArrays& normals = sample.normals;
  __m256i num = _mm256_setzero_si256();
  std::size_t i = 0;
  for (; i + 8 <= sample.size; i += 8) {
    const __m256 height = _mm256_add_ps(normal.dot(sample.x + i, sample.y + i, sample.z + i), offset);
    const __m256 cosine = normal.dot(normals.x + i, normals.y + i, normals.z + i);
    const __m256 is_near = _mm256_cmp_ps(_mm256_andnot_ps(sign, height), thickness, _CMP_LT_OQ),
                 is_alike = _mm256_cmp_ps(cosine, least, _CMP_GT_OQ);
    // A mask is -1 in each lane.
    num = _mm256_sub_epi32(num, _mm256_castps_si256(_mm256_and_ps(is_near, is_alike)));
  }
  alignas(32) std::int32_t lanes[8];
  _mm256_store_si256(reinterpret_cast<__m256i*>(lanes), num);
  const PlaneSample rest{sample.x + i,
                         sample.y + i,
                         sample.z + i,
                         {normals.x + i, normals.y + i, normals.z + i},
                         sample.size - i};
  return std::accumulate(lanes, lanes + 8, portable_kernels().count_on_plane(test, rest));
}

GRASPD_AVX2 void solve_planes(const MomentLanes& moments, NormalLanes& normals) {
  const Matrices c = covariances(moments);
  const __m256 minors = sum_of_minors(c), t = smallest_eigenvalues(c, minors);
  const __m256 a = _mm256_sub_ps(c.xx, t), b = _mm256_sub_ps(c.yy, t), d = _mm256_sub_ps(c.zz, t);
  const Vectors first{minor(c.xy, c.yz, c.xz, b), minor(c.xz, c.xy, a, c.yz), minor(a, b, c.xy, c.xy)},
      second{minor(c.xy, d, c.xz, c.yz), minor(c.xz, c.xz, a, d), minor(a, c.yz, c.xy, c.xz)},
      third{minor(b, d, c.yz, c.yz), minor(c.yz, c.xz, c.xy, d), minor(c.xy, c.yz, b, c.xz)};
  const __m256 n0 = first.squared(), n1 = second.squared(), n2 = third.squared();
  const __m256 is_second = _mm256_cmp_ps(n1, n0, _CMP_GT_OQ), n01 = _mm256_blendv_ps(n0, n1, is_second),
               is_third = _mm256_cmp_ps(n2, n01, _CMP_GT_OQ), n = _mm256_blendv_ps(n01, n2, is_third);
  const Vectors longest = first.blended(second, is_second).blended(third, is_third);
  const __m256 is_plane = _mm256_and_ps(_mm256_cmp_ps(n, _mm256_set1_ps(1e-16f), _CMP_GT_OQ),
                                        _mm256_cmp_ps(minors, _mm256_set1_ps(1e-5f), _CMP_GT_OQ));
  const __m256 scale = _mm256_and_ps(is_plane, _mm256_div_ps(_mm256_set1_ps(1), _mm256_sqrt_ps(n)));
  _mm256_storeu_ps(normals.x, mul(scale, longest.x));
  _mm256_storeu_ps(normals.y, mul(scale, longest.y));
  _mm256_storeu_ps(normals.z, mul(scale, longest.z));
}

GRASPD_AVX2 std::size_t count_bent(const NormalArrays& normals, std::uint32_t s, float limit,
                                   const std::uint32_t* indices, std::size_t n) {
  const Vectors normal = normal_of(normals, s);
  const __m256 most = _mm256_set1_ps(limit);
  std::size_t count = 0;
  for (std::size_t k = 0; k < n; k += 8) {
    const __m256 bent = _mm256_cmp_ps(cosines(normals, normal, load(indices + k)), most, _CMP_LT_OQ);
    count += static_cast<std::size_t>(std::popcount(valid_lanes(_mm256_movemask_ps(bent), k, n)));
  }
  return count;
}

GRASPD_AVX2 FoundLinks find_links(const LinkTest& test, const LinkPlace& place, const std::uint32_t* indices,
                                  std::size_t n, std::uint32_t* out) {
  const Vectors normal = normal_of(test.normals, place.point);
  const __m256 least = _mm256_set1_ps(test.least_cosine[place.point]);
  const __m256i root = _mm256_set1_epi32(static_cast<int>(place.root)),
                before = _mm256_set1_epi32(static_cast<int>(place.first) - 1),
                last = _mm256_set1_epi32(static_cast<int>(place.last));
  __m256i beyond = _mm256_setzero_si256();
  std::size_t num = 0;
  for (std::size_t k = 0; k < n; k += 8) {
    const __m256i i = load(indices + k);
    __m256i lanes = _mm256_cmpgt_epi32(i, before);
    if (k + 8 > n) lanes = _mm256_and_si256(lanes, _mm256_castps_si256(lanes_left(n - k)));
    const __m256i in_reach = _mm256_cmpgt_epi32(last, i);
    beyond = _mm256_or_si256(beyond, _mm256_andnot_si256(in_reach, lanes));
    lanes = _mm256_and_si256(lanes, in_reach);
    if (_mm256_testz_si256(lanes, lanes)) continue;
    const __m256i parent = _mm256_mask_i32gather_epi32(root, reinterpret_cast<const int*>(test.parent), i,
                                                       lanes, sizeof(std::uint32_t));
    const __m256i others = _mm256_andnot_si256(_mm256_cmpeq_epi32(parent, root), lanes);
    if (_mm256_testz_si256(others, others)) continue;
    const __m256 limit = _mm256_max_ps(least, _mm256_i32gather_ps(test.least_cosine, i, sizeof(float)));
    const __m256 linked = _mm256_cmp_ps(cosines(test.normals, normal, i), limit, _CMP_GT_OQ);
    const unsigned mask = mask_of(_mm256_and_ps(linked, _mm256_castsi256_ps(others)));
    store_index(out + num, indices + k, lanes_of(mask));
    num += static_cast<std::size_t>(std::popcount(mask));
  }
  return {num, _mm256_testz_si256(beyond, beyond) == 0};
}

GRASPD_AVX2 bool any_other(const std::int32_t* values, std::int32_t value, const std::uint32_t* indices,
                           std::size_t n) {
  const __m256i own = _mm256_set1_epi32(value);
  const auto same_lanes = [&](std::size_t k) GRASPD_AVX2 {
    const __m256i v = _mm256_i32gather_epi32(values, load(indices + k), sizeof(std::int32_t));
    return mask_of(_mm256_castsi256_ps(_mm256_cmpeq_epi32(v, own)));
  };
  std::size_t k = 0;
  for (; k + 8 <= n; k += 8)
    if (same_lanes(k) != 0xff) return true;
  return k < n && (~same_lanes(k) & first_lanes(n - k)) != 0;
}

}  // namespace graspd::avx2

#endif

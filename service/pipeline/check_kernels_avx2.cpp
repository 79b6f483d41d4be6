// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What a check does with the points that it gathered, eight at a time. Products and sums stay separate
// operations, as in point_kernels_avx2.cpp.
#include <algorithm>

#include "service/pipeline/avx2_lanes.hpp"

#if defined(__x86_64__)

namespace graspd::avx2 {
namespace {

GRASPD_AVX2 inline double sum_in_order(__m256d v) {
  alignas(32) double part[4];
  _mm256_store_pd(part, v);
  return part[0] + part[1] + part[2] + part[3];
}

/// Adds what four points give to their four parts.
GRASPD_AVX2 inline void add_to_circle(__m128 xs, __m128 ys, __m128 weights, __m256d (&sum)[9]) {
  const __m256d x = _mm256_cvtps_pd(xs), y = _mm256_cvtps_pd(ys), w = _mm256_cvtps_pd(weights);
  const __m256d wx = _mm256_mul_pd(w, x), wy = _mm256_mul_pd(w, y),
                wq = _mm256_mul_pd(w, _mm256_add_pd(_mm256_mul_pd(x, x), _mm256_mul_pd(y, y)));
  sum[0] = _mm256_add_pd(sum[0], w);
  sum[1] = _mm256_add_pd(sum[1], wx);
  sum[2] = _mm256_add_pd(sum[2], wy);
  sum[3] = _mm256_add_pd(sum[3], _mm256_mul_pd(wx, x));
  sum[4] = _mm256_add_pd(sum[4], _mm256_mul_pd(wx, y));
  sum[5] = _mm256_add_pd(sum[5], _mm256_mul_pd(wy, y));
  sum[6] = _mm256_add_pd(sum[6], wq);
  sum[7] = _mm256_add_pd(sum[7], _mm256_mul_pd(wq, x));
  sum[8] = _mm256_add_pd(sum[8], _mm256_mul_pd(wq, y));
}

/// Where places fall along one side of the image, of those at these coordinates in the view.
GRASPD_AVX2 inline __m256 on_image(float focal, float center, __m256 x, __m256 depth) {
  const __m256 scaled = _mm256_div_ps(_mm256_mul_ps(_mm256_set1_ps(focal), x), depth);
  return _mm256_add_ps(_mm256_add_ps(scaled, _mm256_set1_ps(center)), _mm256_set1_ps(0.5f));
}

GRASPD_AVX2 inline __m256 in_side(__m256 v, std::int32_t side) {
  return _mm256_and_ps(_mm256_cmp_ps(v, _mm256_setzero_ps(), _CMP_GE_OQ),
                       _mm256_cmp_ps(v, _mm256_set1_ps(static_cast<float>(side)), _CMP_LT_OQ));
}

/// Which points of a band are within limits.
struct Band {
  __m256 middle, top, min_distance, max_distance, min_depth, max_depth;

  GRASPD_AVX2 explicit Band(const BandLimits& limits)
      : middle(_mm256_set1_ps(limits.middle)),
        top(_mm256_set1_ps(limits.top)),
        min_distance(_mm256_set1_ps(limits.min_distance)),
        max_distance(_mm256_set1_ps(limits.max_distance)),
        min_depth(_mm256_set1_ps(limits.min_depth)),
        max_depth(_mm256_set1_ps(limits.max_depth)) {}

  /// Of the eight points from k on.
  GRASPD_AVX2 __m256 within(const BandPoints& points, std::size_t k) const {
    const __m256 distance =
        _mm256_andnot_ps(_mm256_set1_ps(-0.0f), _mm256_sub_ps(_mm256_loadu_ps(points.f + k), middle));
    const __m256 depth = _mm256_sub_ps(_mm256_loadu_ps(points.z + k), top);
    return _mm256_and_ps(_mm256_and_ps(_mm256_cmp_ps(distance, min_distance, _CMP_GE_OQ),
                                       _mm256_cmp_ps(distance, max_distance, _CMP_LE_OQ)),
                         _mm256_and_ps(_mm256_cmp_ps(depth, min_depth, _CMP_GE_OQ),
                                       _mm256_cmp_ps(depth, max_depth, _CMP_LE_OQ)));
  }
};

/// Writes k and what is set in the mask of the lanes from it on; the number written so far.
GRASPD_AVX2 inline std::size_t write_positions(unsigned mask, std::size_t k, std::uint32_t* out,
                                               std::size_t n) {
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(out + n),
                      _mm256_add_epi32(lanes_of(mask), _mm256_set1_epi32(static_cast<int>(k))));
  return n + static_cast<std::size_t>(std::popcount(mask));
}

/// Of eight points those of the object.
GRASPD_AVX2 inline unsigned own_lanes(const std::int32_t* own) {
  const __m256i is_own = _mm256_cmpgt_epi32(load(own), _mm256_setzero_si256());
  return static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(is_own)));
}

}  // namespace

GRASPD_AVX2 CircleSums sum_circle(const CircleWeights& weights, const float* xs, const float* ys,
                                  std::size_t n) {
  const __m256 cx = _mm256_set1_ps(weights.x), cy = _mm256_set1_ps(weights.y),
               radius = _mm256_set1_ps(weights.radius), per_scale = _mm256_set1_ps(weights.per_scale),
               one = _mm256_set1_ps(1);
  __m256d sum[9];
  for (__m256d& s : sum) s = _mm256_setzero_pd();
  for (std::size_t i = 0; i < n; i += 8) {
    // Points beyond the last are zero and have no weight.
    const __m256 valid = lanes_left(n - i);
    const __m256 x = _mm256_and_ps(valid, _mm256_loadu_ps(xs + i)),
                 y = _mm256_and_ps(valid, _mm256_loadu_ps(ys + i));
    const __m256 dx = _mm256_sub_ps(x, cx), dy = _mm256_sub_ps(y, cy);
    const __m256 distance = _mm256_sqrt_ps(_mm256_add_ps(_mm256_mul_ps(dx, dx), _mm256_mul_ps(dy, dy)));
    const __m256 e = _mm256_mul_ps(_mm256_sub_ps(distance, radius), per_scale);
    const __m256 w = _mm256_and_ps(valid, _mm256_div_ps(one, _mm256_add_ps(one, _mm256_mul_ps(e, e))));
    add_to_circle(_mm256_castps256_ps128(x), _mm256_castps256_ps128(y), _mm256_castps256_ps128(w), sum);
    add_to_circle(_mm256_extractf128_ps(x, 1), _mm256_extractf128_ps(y, 1), _mm256_extractf128_ps(w, 1), sum);
  }
  double total[9];
  for (int k = 0; k < 9; ++k) total[k] = sum_in_order(sum[k]);
  return {total[0], total[1], total[2], total[3], total[4], total[5], total[6], total[7], total[8]};
}

GRASPD_AVX2 ProfileSums sum_profile(const ProfileWeights& weights, const FacePoints& face) {
  __m256 c[4], sum[14];
  for (int k = 0; k < 4; ++k) c[k] = _mm256_set1_ps(weights.c[k]);
  for (__m256& v : sum) v = _mm256_setzero_ps();
  const __m256 per_scale = _mm256_set1_ps(weights.per_scale), one = _mm256_set1_ps(1);
  for (std::size_t i = 0; i < face.size; i += 8) {
    // Points beyond the last are zero and have no weight.
    const __m256 valid = lanes_left(face.size - i);
    const auto part = [&](const float* v)
                          GRASPD_AVX2 { return _mm256_and_ps(valid, _mm256_loadu_ps(v + i)); };
    const __m256 s = part(face.s), a = part(face.a), z = part(face.z), ss = _mm256_mul_ps(s, s);
    const __m256 line = _mm256_add_ps(c[0], _mm256_mul_ps(c[1], s)),
                 rest = _mm256_add_ps(_mm256_mul_ps(c[2], ss), _mm256_mul_ps(c[3], a));
    const __m256 e = _mm256_mul_ps(_mm256_sub_ps(_mm256_add_ps(line, rest), z), per_scale);
    const __m256 ee = _mm256_mul_ps(e, e);
    const __m256 w = _mm256_and_ps(valid, _mm256_div_ps(one, _mm256_add_ps(one, ee)));
    const __m256 ws = _mm256_mul_ps(w, s), wss = _mm256_mul_ps(w, ss), wa = _mm256_mul_ps(w, a),
                 wz = _mm256_mul_ps(w, z);
    const __m256 terms[14] = {w,
                              ws,
                              wss,
                              _mm256_mul_ps(wss, s),
                              _mm256_mul_ps(wss, ss),
                              wa,
                              _mm256_mul_ps(wa, s),
                              _mm256_mul_ps(wa, ss),
                              _mm256_mul_ps(wa, a),
                              wz,
                              _mm256_mul_ps(wz, s),
                              _mm256_mul_ps(wz, ss),
                              _mm256_mul_ps(wz, a),
                              _mm256_mul_ps(w, ee)};
    for (int k = 0; k < 14; ++k) sum[k] = _mm256_add_ps(sum[k], terms[k]);
  }
  float total[14];
  for (int k = 0; k < 14; ++k) total[k] = sum_in_order(sum[k]);
  return {total[0], total[1], total[2], total[3],  total[4],  total[5],  total[6],
          total[7], total[8], total[9], total[10], total[11], total[12], total[13]};
}

GRASPD_AVX2 void find_hiders(const ViewImage& image, const Probes& places, float margin_m,
                             std::int32_t (&hiders)[kProbes]) {
  const __m256 dx = _mm256_sub_ps(_mm256_loadu_ps(places.x), _mm256_set1_ps(image.origin[0])),
               dy = _mm256_sub_ps(_mm256_loadu_ps(places.y), _mm256_set1_ps(image.origin[1])),
               dz = _mm256_sub_ps(_mm256_loadu_ps(places.z), _mm256_set1_ps(image.origin[2]));
  __m256 view[3];
  for (int i = 0; i < 3; ++i) {
    const auto axis = [&](int j) GRASPD_AVX2 { return _mm256_set1_ps(image.axes[i][j]); };
    view[i] = _mm256_add_ps(_mm256_add_ps(_mm256_mul_ps(axis(0), dx), _mm256_mul_ps(axis(1), dy)),
                            _mm256_mul_ps(axis(2), dz));
  }
  const __m256 u = on_image(image.focal[0], image.center[0], view[0], view[2]),
               v = on_image(image.focal[1], image.center[1], view[1], view[2]), zero = _mm256_setzero_ps();
  const __m256 before = _mm256_cmp_ps(view[2], zero, _CMP_GT_OQ),
               inside =
                   _mm256_and_ps(before, _mm256_and_ps(in_side(u, image.width), in_side(v, image.height)));
  const __m256i pixel = _mm256_add_epi32(
      _mm256_mullo_epi32(_mm256_cvttps_epi32(v), _mm256_set1_epi32(image.width)), _mm256_cvttps_epi32(u));
  const __m256 depth = _mm256_mask_i32gather_ps(zero, image.depth, pixel, inside, sizeof(float));
  const __m256 hides =
      _mm256_and_ps(_mm256_cmp_ps(depth, zero, _CMP_GT_OQ),
                    _mm256_cmp_ps(depth, _mm256_sub_ps(view[2], _mm256_set1_ps(margin_m)), _CMP_LT_OQ));
  const __m256 is_above = _mm256_cmp_ps(v, zero, _CMP_LT_OQ),
               is_below = _mm256_cmp_ps(v, _mm256_set1_ps(static_cast<float>(image.height)), _CMP_GE_OQ),
               is_beyond = _mm256_andnot_ps(inside, before);
  __m256i other = _mm256_set1_epi32(image.beside);
  other = _mm256_blendv_epi8(other, _mm256_set1_epi32(image.below), _mm256_castps_si256(is_below));
  other = _mm256_blendv_epi8(other, _mm256_set1_epi32(image.above), _mm256_castps_si256(is_above));
  other = _mm256_blendv_epi8(_mm256_set1_epi32(-1), other, _mm256_castps_si256(is_beyond));
  const __m256i hider = _mm256_mask_i32gather_epi32(other, image.point, pixel, _mm256_castps_si256(hides),
                                                    sizeof(std::int32_t));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(hiders), hider);
}

GRASPD_AVX2 void tag_band(const BandTags& tags, const BandPoints& points, std::int32_t* own,
                          std::int32_t* marks) {
  const __m256 first = _mm256_set1_ps(tags.first), bin = _mm256_set1_ps(tags.bin);
  const __m256i object = _mm256_set1_epi32(tags.object), last = _mm256_set1_epi32(tags.num_bins - 1),
                no_mark = _mm256_set1_epi32(tags.no_mark()),
                stride = _mm256_set1_epi32(static_cast<int>(tags.stride()));
  std::size_t k = 0;
  for (; k + 8 <= points.size; k += 8) {
    const __m256i voxel = _mm256_i32gather_epi32(reinterpret_cast<const int*>(tags.voxel_of_point),
                                                 load(points.index + k), sizeof(std::uint32_t));
    const __m256i of_point = _mm256_i32gather_epi32(tags.object_of_voxel, voxel, sizeof(std::int32_t));
    const __m256i same = _mm256_cmpeq_epi32(of_point, object);
    const __m256i is_own = _mm256_srli_epi32(same, 31);
    const __m256i b = floor_to_int(_mm256_div_ps(_mm256_sub_ps(_mm256_loadu_ps(points.f + k), first), bin));
    const __m256i outside = _mm256_or_si256(b, _mm256_cmpgt_epi32(b, last));  // by its sign
    const __m256i none = _mm256_srai_epi32(outside, 31);
    const __m256i mark = _mm256_add_epi32(b, _mm256_and_si256(same, stride));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(own + k), is_own);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(marks + k), _mm256_blendv_epi8(mark, no_mark, none));
  }
  portable_kernels().tag_band(tags, {points.f + k, points.z + k, points.index + k, points.size - k}, own + k,
                              marks + k);
}

GRASPD_AVX2 std::size_t keep_depths(const BandPoints& points, const std::int32_t* own, const BandPart& part,
                                    float* out) {
  const __m256 f_min = _mm256_set1_ps(part.f_min), f_max = _mm256_set1_ps(part.f_max),
               z_min = _mm256_set1_ps(part.z_min);
  std::size_t n = 0;
  for (std::size_t k = 0; k < points.size; k += 8) {
    const __m256 f = _mm256_loadu_ps(points.f + k), z = _mm256_loadu_ps(points.z + k);
    const __m256 between =
        _mm256_and_ps(_mm256_cmp_ps(f, f_min, _CMP_GE_OQ), _mm256_cmp_ps(f, f_max, _CMP_LE_OQ));
    const __m256 is_own = _mm256_castsi256_ps(_mm256_cmpgt_epi32(load(own + k), _mm256_setzero_si256()));
    const __m256 is_in = _mm256_and_ps(_mm256_and_ps(between, _mm256_cmp_ps(z, z_min, _CMP_GE_OQ)), is_own);
    const unsigned mask = valid_lanes(_mm256_movemask_ps(is_in), k, points.size);
    if (mask == 0) continue;
    store(out + n, z, lanes_of(mask));
    n += static_cast<std::size_t>(std::popcount(mask));
  }
  return n;
}

GRASPD_AVX2 std::size_t select_band(const BandLimits& limits, const BandPoints& points, std::uint32_t* out) {
  const Band band(limits);
  std::size_t n = 0;
  for (std::size_t k = 0; k < points.size; k += 8) {
    const unsigned mask = valid_lanes(_mm256_movemask_ps(band.within(points, k)), k, points.size);
    if (mask != 0) n = write_positions(mask, k, out, n);
  }
  return n;
}

GRASPD_AVX2 BandCounts select_own(const BandLimits& limits, const BandPoints& points, const std::int32_t* own,
                                  std::uint32_t* out) {
  const Band band(limits);
  BandCounts n{0, 0};
  for (std::size_t k = 0; k < points.size; k += 8) {
    const unsigned mask = valid_lanes(_mm256_movemask_ps(band.within(points, k)), k, points.size);
    if (mask == 0) continue;
    n.all += static_cast<std::size_t>(std::popcount(mask));
    n.own = write_positions(mask & own_lanes(own + k), k, out, n.own);
  }
  return n;
}

GRASPD_AVX2 void extend_own(const BandLimits& limits, const BandPoints& points, const std::int32_t* own,
                            float& low, float& high) {
  const Band band(limits);
  __m256 lows = _mm256_set1_ps(low), highs = _mm256_set1_ps(high);
  for (std::size_t k = 0; k < points.size; k += 8) {
    const __m256 is_own = _mm256_castsi256_ps(_mm256_cmpgt_epi32(load(own + k), _mm256_setzero_si256()));
    const __m256 chosen =
        _mm256_and_ps(_mm256_and_ps(band.within(points, k), is_own), lanes_left(points.size - k));
    const __m256 f = _mm256_loadu_ps(points.f + k);
    lows = _mm256_min_ps(lows, _mm256_blendv_ps(lows, f, chosen));
    highs = _mm256_max_ps(highs, _mm256_blendv_ps(highs, f, chosen));
  }
  alignas(32) float lanes[8];
  _mm256_store_ps(lanes, lows);
  low = *std::min_element(lanes, lanes + 8);
  _mm256_store_ps(lanes, highs);
  high = *std::max_element(lanes, lanes + 8);
}

GRASPD_AVX2 void mark_band(const BandLimits& limits, const BandPoints& points, const std::int32_t* marks,
                           std::uint8_t* marked) {
  const Band band(limits);
  for (std::size_t k = 0; k < points.size; k += 8) {
    unsigned mask = valid_lanes(_mm256_movemask_ps(band.within(points, k)), k, points.size);
    if (mask == 0xff) {  // as most that have any
      for (std::size_t i = 0; i < 8; ++i) marked[marks[k + i]] = 1;
      continue;
    }
    for (; mask != 0; mask &= mask - 1) marked[marks[k + static_cast<unsigned>(std::countr_zero(mask))]] = 1;
  }
}

}  // namespace graspd::avx2

#endif

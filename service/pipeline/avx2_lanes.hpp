// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What the kernels for AVX2 share. Included by their files alone.
#pragma once
#include "service/pipeline/point_kernels.hpp"

#if defined(__x86_64__)
#include <immintrin.h>

#include <array>
#include <bit>

#define GRASPD_AVX2 __attribute__((target("avx2,popcnt")))

namespace graspd::avx2 {

/// For each mask of eight lanes the lanes that are set, first ones first.
constexpr std::array<std::array<std::uint32_t, 8>, 256> make_lane_table() {
  std::array<std::array<std::uint32_t, 8>, 256> table{};
  for (unsigned mask = 0; mask < 256; ++mask) {
    std::size_t n = 0;
    for (unsigned lane = 0; lane < 8; ++lane)
      if ((mask >> lane) & 1) table[mask][n++] = lane;
  }
  return table;
}

alignas(32) inline constexpr auto kLanes = make_lane_table();

GRASPD_AVX2 inline __m256i lanes_of(unsigned mask) {
  return _mm256_load_si256(reinterpret_cast<const __m256i*>(kLanes[mask].data()));
}

GRASPD_AVX2 inline void store(float* to, __m256 v, __m256i lanes) {
  _mm256_storeu_ps(to, _mm256_permutevar8x32_ps(v, lanes));
}

GRASPD_AVX2 inline void store_index(std::uint32_t* to, const std::uint32_t* from, __m256i lanes) {
  const __m256i v = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm256_permutevar8x32_epi32(v, lanes));
}

inline unsigned first_lanes(std::size_t n) {
  return (1u << n) - 1;
}

/// Of a mask of the block of eight that begins at k the lanes that hold points, of so many points.
inline unsigned valid_lanes(int mask, std::size_t k, std::size_t size) {
  const auto lanes = static_cast<unsigned>(mask);
  return k + 8 <= size ? lanes : lanes & first_lanes(size - k);
}

GRASPD_AVX2 inline __m256i load(const void* from) {
  return _mm256_loadu_si256(static_cast<const __m256i*>(from));
}

/// All bits set in the lanes of the next eight that hold something, of so many left.
GRASPD_AVX2 inline __m256 lanes_left(std::size_t n) {
  const __m256i lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  return _mm256_castsi256_ps(_mm256_cmpgt_epi32(_mm256_set1_epi32(static_cast<int>(n)), lane));
}

/// Of the eight lanes, in their order.
GRASPD_AVX2 inline float sum_in_order(__m256 v) {
  alignas(32) float part[8];
  _mm256_store_ps(part, v);
  float sum = 0;
  for (const float p : part) sum += p;
  return sum;
}

GRASPD_AVX2 inline __m256i floor_to_int(__m256 v) {
  const __m256i truncated = _mm256_cvttps_epi32(v);
  const __m256 above = _mm256_cmp_ps(_mm256_cvtepi32_ps(truncated), v, _CMP_GT_OQ);
  return _mm256_add_epi32(truncated, _mm256_castps_si256(above));  // the mask is -1 where that rounded up
}

// What a frame is filtered with.
std::size_t test_workspace(const WorkspaceTest& test, const float* x, const float* y, const float* z,
                           std::size_t n, std::uint8_t* masks);
void copy_chosen(const float* x, const float* y, const float* z, const std::uint8_t* masks, std::size_t n,
                 const ChosenPoints& out);

// What surfaces are found with.
std::size_t keep_near(const float (&p)[3], float distance_squared, const PointRange& points,
                      std::span<const PointSpan> spans, std::uint32_t* out);
std::size_t copy_inside(const float (&min)[3], const float (&max)[3], const PointRange& points,
                        std::span<const PointSpan> spans, const LocalOutput& out);
int count_on_plane(const PlaneTest& test, const PlaneSample& sample);
void solve_planes(const MomentLanes& moments, NormalLanes& normals);
std::size_t count_bent(const NormalArrays& normals, std::uint32_t s, float limit,
                       const std::uint32_t* indices, std::size_t n);
FoundLinks find_links(const LinkTest& test, const LinkPlace& place, const std::uint32_t* indices,
                      std::size_t n, std::uint32_t* out);
bool any_other(const std::int32_t* values, std::int32_t value, const std::uint32_t* indices, std::size_t n);
std::size_t list_above(const std::int32_t* values, std::int32_t limit, const std::uint32_t* indices,
                       std::size_t n, std::uint32_t* out);
std::size_t list_members(const std::int32_t* values, std::size_t n, std::uint32_t* out);
std::size_t list_unmarked(const std::uint8_t* marks, std::size_t n, std::uint32_t* out);
void first_few(const float* v, std::size_t n, bool largest, float (&out)[kFew]);

// What points are brought into order with.
std::size_t count_changes(const std::uint32_t* keys, std::size_t n);
void write_runs(const std::uint32_t* keys, std::size_t begin, std::size_t end, CellRun<std::uint32_t>* out,
                std::size_t num);
CellCounts count_cells(const CellRun<std::uint32_t>* list, std::size_t begin, std::size_t end);
void write_cells(const CellRun<std::uint32_t>* list, std::size_t begin, std::size_t end, CellOutput out);
void copy_at(const PointRange& points, std::span<const std::uint32_t> positions, const LocalOutput& out);
void set_means(const CellPoints& cells, float* x, float* y, float* z);
void find_middles(const CellPoints& cells, std::uint32_t* out);

// What a depth image is rendered with.
void sum_directions(const ViewImage& view, const PointRange& points, DirectionSums& sums);
void extend_slopes(const ViewImage& view, const PointRange& points, SlopeBounds& bounds);
void find_pixels(const ViewImage& view, const PointRange& points, std::int32_t* pixels, float* depths);

// What a check does with the points that it gathered.
CircleSums sum_circle(const CircleWeights& weights, const float* xs, const float* ys, std::size_t n);
ProfileSums sum_profile(const ProfileWeights& weights, const FacePoints& face);
void find_hiders(const ViewImage& image, const Probes& places, float margin_m,
                 std::int32_t (&hiders)[kProbes]);
void tag_band(const BandTags& tags, const BandPoints& points, std::int32_t* own, std::int32_t* marks);
std::size_t keep_depths(const BandPoints& points, const std::int32_t* own, const BandPart& part, float* out);
std::size_t select_band(const BandLimits& limits, const BandPoints& points, std::uint32_t* out);
BandCounts select_own(const BandLimits& limits, const BandPoints& points, const std::int32_t* own,
                      std::uint32_t* out);
void extend_own(const BandLimits& limits, const BandPoints& points, const std::int32_t* own, float& low,
                float& high);
void mark_band(const BandLimits& limits, const BandPoints& points, const std::int32_t* marks,
               std::uint8_t* marked);

}  // namespace graspd::avx2

#endif

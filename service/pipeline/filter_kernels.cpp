// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Which points of a frame are in the workspace, in both forms. Products and sums stay separate operations, as
// in point_kernels_avx2.cpp.
#include <algorithm>
#include <bit>

#include "service/pipeline/avx2_lanes.hpp"
#include "service/pipeline/surface_kernels.hpp"

namespace graspd {
namespace portable {
namespace {

constexpr std::size_t kBlock = 64;

struct Flags {
  int finite[kBlock], inside[kBlock];
};

/// Plain scalars and arrays, so that the compiler can use the vectors that every processor has.
void test_block(const WorkspaceTest& test, const float* xs, const float* ys, const float* zs, std::size_t n,
                Flags& flags) {
  const auto& m = test.box.to_local;
  const auto &shift = test.box.shift, &min = test.box.min, &max = test.box.max;
  const float ox = test.origin[0], oy = test.origin[1], oz = test.origin[2];
  const float least = test.least_squared, most = test.most_squared;
  int *finite = flags.finite, *inside = flags.inside;
  for (std::size_t k = 0; k < n; ++k) {
    const float x = xs[k], y = ys[k], z = zs[k];
    const float dx = x - ox, dy = y - oy, dz = z - oz;
    const float squared = dx * dx + dy * dy + dz * dz;
    const float u = m[0][0] * x + m[0][1] * y + m[0][2] * z + shift[0],
                v = m[1][0] * x + m[1][1] * y + m[1][2] * z + shift[1],
                w = m[2][0] * x + m[2][1] * y + m[2][2] * z + shift[2];
    // The difference is NaN for what is not finite.
    finite[k] = int{x - x == 0} & int{y - y == 0} & int{z - z == 0};
    inside[k] = finite[k] & int{squared >= least} & int{squared <= most} & int{u >= min[0]} &
                int{u <= max[0]} & int{v >= min[1]} & int{v <= max[1]} & int{w >= min[2]} & int{w <= max[2]};
  }
}

}  // namespace

std::size_t test_workspace(const WorkspaceTest& test, const float* x, const float* y, const float* z,
                           std::size_t n, std::uint8_t* masks) {
  Flags flags;
  std::size_t num_finite = 0;
  for (std::size_t from = 0; from < n; from += kBlock) {
    const std::size_t size = std::min(kBlock, n - from);
    test_block(test, x + from, y + from, z + from, size, flags);
    for (std::size_t k = 0; k < size; ++k) {
      std::uint8_t& mask = masks[(from + k) / 8];
      const int bit = flags.inside[k] << (k % 8);
      mask = static_cast<std::uint8_t>(k % 8 == 0 ? bit : mask | bit);
      num_finite += static_cast<std::size_t>(flags.finite[k]);
    }
  }
  return num_finite;
}

void copy_chosen(const float* x, const float* y, const float* z, const std::uint8_t* masks, std::size_t n,
                 const ChosenPoints& out) {
  std::size_t to = 0;
  for (std::size_t k = 0; k < n; ++k) {
    if (((masks[k / 8] >> (k % 8)) & 1) == 0) continue;
    out.x[to] = x[k];
    out.y[to] = y[k];
    out.z[to] = z[k];
    if (out.position != nullptr) out.position[to] = out.first + static_cast<std::uint32_t>(k);
    ++to;
  }
}

}  // namespace portable

#if defined(__x86_64__)

namespace avx2 {
namespace {

struct Workspace {
  __m256 m[3][3], shift[3], min[3], max[3], origin[3], least, most;
  bool is_aligned = true;  // the box, with the axes of the points: each coordinate comes out as it is

  GRASPD_AVX2 explicit Workspace(const WorkspaceTest& test)
      : least(_mm256_set1_ps(test.least_squared)), most(_mm256_set1_ps(test.most_squared)) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j)
        is_aligned = is_aligned && test.box.to_local[i][j] == (i == j ? 1.0f : 0.0f);
      is_aligned = is_aligned && test.box.shift[i] == 0;
      for (int j = 0; j < 3; ++j) m[i][j] = _mm256_set1_ps(test.box.to_local[i][j]);
      shift[i] = _mm256_set1_ps(test.box.shift[i]);
      min[i] = _mm256_set1_ps(test.box.min[i]);
      max[i] = _mm256_set1_ps(test.box.max[i]);
      origin[i] = _mm256_set1_ps(test.origin[i]);
    }
  }

  GRASPD_AVX2 static __m256 between(__m256 v, __m256 low, __m256 high) {
    return _mm256_and_ps(_mm256_cmp_ps(v, low, _CMP_GE_OQ), _mm256_cmp_ps(v, high, _CMP_LE_OQ));
  }

  GRASPD_AVX2 __m256 holds(__m256 x, __m256 y, __m256 z) const {
    const __m256 dx = _mm256_sub_ps(x, origin[0]), dy = _mm256_sub_ps(y, origin[1]),
                 dz = _mm256_sub_ps(z, origin[2]);
    const __m256 squared =
        _mm256_add_ps(_mm256_add_ps(_mm256_mul_ps(dx, dx), _mm256_mul_ps(dy, dy)), _mm256_mul_ps(dz, dz));
    __m256 lanes = between(squared, least, most);
    if (is_aligned)
      return _mm256_and_ps(_mm256_and_ps(lanes, between(x, min[0], max[0])),
                           _mm256_and_ps(between(y, min[1], max[1]), between(z, min[2], max[2])));
    for (int i = 0; i < 3; ++i) {
      const __m256 xy = _mm256_add_ps(_mm256_mul_ps(m[i][0], x), _mm256_mul_ps(m[i][1], y));
      const __m256 local = _mm256_add_ps(_mm256_add_ps(xy, _mm256_mul_ps(m[i][2], z)), shift[i]);
      lanes = _mm256_and_ps(lanes, between(local, min[i], max[i]));
    }
    return lanes;
  }
};

/// All bits set in the lanes that are finite: the difference is NaN for what is not.
GRASPD_AVX2 inline __m256 finite_lanes(__m256 x, __m256 y, __m256 z) {
  const __m256 dx = _mm256_sub_ps(x, x), dy = _mm256_sub_ps(y, y), dz = _mm256_sub_ps(z, z);
  return _mm256_and_ps(_mm256_cmp_ps(dx, dy, _CMP_EQ_OQ), _mm256_cmp_ps(dz, dz, _CMP_ORD_Q));
}

/// Where the points from the k-th on go, after so many.
inline ChosenPoints rest(const ChosenPoints& out, std::size_t to, std::size_t k) {
  return {out.x + to,    out.y + to,
          out.z + to,    out.position != nullptr ? out.position + to : nullptr,
          out.room - to, out.first + static_cast<std::uint32_t>(k)};
}

GRASPD_AVX2 inline unsigned mask_of(__m256 lanes) {
  return static_cast<unsigned>(_mm256_movemask_ps(lanes));
}

}  // namespace

GRASPD_AVX2 std::size_t test_workspace(const WorkspaceTest& test, const float* x, const float* y,
                                       const float* z, std::size_t n, std::uint8_t* masks) {
  const Workspace workspace(test);
  std::size_t num_finite = 0, k = 0;
  for (; k + 8 <= n; k += 8) {
    const __m256 px = _mm256_loadu_ps(x + k), py = _mm256_loadu_ps(y + k), pz = _mm256_loadu_ps(z + k);
    const __m256 finite = finite_lanes(px, py, pz);
    num_finite += static_cast<std::size_t>(std::popcount(mask_of(finite)));
    masks[k / 8] = static_cast<std::uint8_t>(mask_of(_mm256_and_ps(finite, workspace.holds(px, py, pz))));
  }
  return num_finite + portable::test_workspace(test, x + k, y + k, z + k, n - k, masks + k / 8);
}

GRASPD_AVX2 void copy_chosen(const float* x, const float* y, const float* z, const std::uint8_t* masks,
                             std::size_t n, const ChosenPoints& out) {
  const __m256i iota = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  std::size_t to = 0, k = 0;
  for (; k + 8 <= n; k += 8) {
    if (to + 8 > out.room) {
      // The last few: eight would be written.
      if (masks[k / 8] != 0) portable::copy_chosen(x + k, y + k, z + k, masks + k / 8, 8, rest(out, to, k));
      to += static_cast<std::size_t>(std::popcount(unsigned{masks[k / 8]}));
      continue;
    }
    const __m256i lanes = lanes_of(masks[k / 8]);
    store(out.x + to, _mm256_loadu_ps(x + k), lanes);
    store(out.y + to, _mm256_loadu_ps(y + k), lanes);
    store(out.z + to, _mm256_loadu_ps(z + k), lanes);
    if (out.position != nullptr) {
      const __m256i positions = _mm256_add_epi32(_mm256_permutevar8x32_epi32(iota, lanes),
                                                 _mm256_set1_epi32(static_cast<int>(out.first + k)));
      _mm256_storeu_si256(reinterpret_cast<__m256i*>(out.position + to), positions);
    }
    to += static_cast<std::size_t>(std::popcount(unsigned{masks[k / 8]}));
  }
  portable::copy_chosen(x + k, y + k, z + k, masks + k / 8, n - k, rest(out, to, k));
}

}  // namespace avx2

#endif

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/surface_kernels.hpp"

#include <algorithm>
#include <cmath>

namespace graspd::portable {
namespace {

using Lanes = float[kSolved];

struct Covariances {
  Lanes xx, xy, xz, yy, yz, zz;
  Lanes minors;  // sum of the principal minors: the product of the two larger eigenvalues where there is a
                 // plane
};

/// Divided by their traces; all zero when there is no extent.
void set_covariances(const MomentLanes& m, Covariances& c) {
  for (std::size_t k = 0; k < kSolved; ++k) {
    const float per = 1.0f / std::max(1.0f, m.count[k]);
    const float xx = m.xx[k] - m.x[k] * m.x[k] * per, xy = m.xy[k] - m.x[k] * m.y[k] * per,
                xz = m.xz[k] - m.x[k] * m.z[k] * per, yy = m.yy[k] - m.y[k] * m.y[k] * per,
                yz = m.yz[k] - m.y[k] * m.z[k] * per, zz = m.zz[k] - m.z[k] * m.z[k] * per;
    const float trace = xx + yy + zz;
    const float scale = m.count[k] >= 3 && trace > 1e-20f ? 1.0f / trace : 0.0f;
    c.xx[k] = xx * scale;
    c.xy[k] = xy * scale;
    c.xz[k] = xz * scale;
    c.yy[k] = yy * scale;
    c.yz[k] = yz * scale;
    c.zz[k] = zz * scale;
  }
}

/// Smallest eigenvalues of symmetric matrices of trace 1, by Newton's method on the characteristic polynomial
/// from below its smallest root, where it converges monotonically.
void smallest_eigenvalues(Covariances& c, Lanes& root) {
  for (std::size_t k = 0; k < kSolved; ++k) {
    const float minors = c.xx[k] * c.yy[k] - c.xy[k] * c.xy[k] + c.xx[k] * c.zz[k] - c.xz[k] * c.xz[k] +
                         c.yy[k] * c.zz[k] - c.yz[k] * c.yz[k];
    const float det = c.xx[k] * (c.yy[k] * c.zz[k] - c.yz[k] * c.yz[k]) -
                      c.xy[k] * (c.xy[k] * c.zz[k] - c.yz[k] * c.xz[k]) +
                      c.xz[k] * (c.xy[k] * c.yz[k] - c.yy[k] * c.xz[k]);
    float t = 0;
    for (int step = 0; step < 8; ++step) {
      const float value = ((t - 1.0f) * t + minors) * t - det;
      const float slope = (3.0f * t - 2.0f) * t + minors;
      t -= value / std::max(slope, 1e-12f);
      t = std::clamp(t, 0.0f, 1.0f / 3.0f);
    }
    root[k] = t;
    c.minors[k] = minors;
  }
}

/// Eigenvectors for the eigenvalues: the longest cross product of two rows of C - t I, unit length, or zero.
void eigenvectors(const Covariances& c, const Lanes& t, NormalLanes& out) {
  for (std::size_t k = 0; k < kSolved; ++k) {
    const float a = c.xx[k] - t[k], b = c.yy[k] - t[k], d = c.zz[k] - t[k];
    const float xy = c.xy[k], xz = c.xz[k], yz = c.yz[k];
    const float x0 = xy * yz - xz * b, y0 = xz * xy - a * yz, z0 = a * b - xy * xy;
    const float x1 = xy * d - xz * yz, y1 = xz * xz - a * d, z1 = a * yz - xy * xz;
    const float x2 = b * d - yz * yz, y2 = yz * xz - xy * d, z2 = xy * yz - b * xz;
    const float n0 = x0 * x0 + y0 * y0 + z0 * z0;
    const float n1 = x1 * x1 + y1 * y1 + z1 * z1;
    const float n2 = x2 * x2 + y2 * y2 + z2 * z2;
    const bool second = n1 > n0;
    const float n01 = second ? n1 : n0;
    const bool third = n2 > n01;
    const float n = third ? n2 : n01;
    // Less on a line, where every axis across it would do: what is left is rounding alone.
    const float scale = n > 1e-16f && c.minors[k] > 1e-5f ? 1.0f / std::sqrt(n) : 0.0f;
    out.x[k] = scale * (third ? x2 : second ? x1 : x0);
    out.y[k] = scale * (third ? y2 : second ? y1 : y0);
    out.z[k] = scale * (third ? z2 : second ? z1 : z0);
  }
}

float cosine(const NormalArrays& n, std::uint32_t a, std::uint32_t b) {
  return n.x[a] * n.x[b] + n.y[a] * n.y[b] + n.z[a] * n.z[b];
}

}  // namespace

void solve_planes(const MomentLanes& moments, NormalLanes& normals) {
  Covariances c;
  Lanes smallest;
  set_covariances(moments, c);
  smallest_eigenvalues(c, smallest);
  eigenvectors(c, smallest, normals);
}

std::size_t copy_inside(const float (&min)[3], const float (&max)[3], const PointRange& points,
                        std::span<const PointSpan> spans, const LocalOutput& out) {
  std::size_t n = 0;
  for (const PointSpan& span : spans)
    for (std::size_t k = span.begin; k < span.end; ++k) {
      const float x = points.x[k], y = points.y[k], z = points.z[k];
      out.a[n] = x;
      out.f[n] = y;
      out.z[n] = z;
      out.index[n] = points.index[k];
      n += static_cast<std::size_t>(int{x >= min[0]} & int{x <= max[0]} & int{y >= min[1]} &
                                    int{y <= max[1]} & int{z >= min[2]} & int{z <= max[2]});
    }
  return n;
}

int count_on_plane(const PlaneTest& test, const PlaneSample& sample) {
  const float nx = test.normal[0], ny = test.normal[1], nz = test.normal[2];
  const NormalArrays& normals = sample.normals;
  int num = 0;
  for (std::size_t i = 0; i < sample.size; ++i) {
    const float height = nx * sample.x[i] + ny * sample.y[i] + nz * sample.z[i] + test.offset;
    const float cosine = nx * normals.x[i] + ny * normals.y[i] + nz * normals.z[i];
    num += int{std::abs(height) < test.thickness} & int{cosine > test.min_cosine};
  }
  return num;
}

std::size_t count_bent(const NormalArrays& normals, std::uint32_t s, float limit,
                       const std::uint32_t* indices, std::size_t n) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < n; ++k) count += cosine(normals, s, indices[k]) < limit ? 1 : 0;
  return count;
}

FoundLinks find_links(const LinkTest& test, const LinkPlace& place, const std::uint32_t* indices,
                      std::size_t n, std::uint32_t* out) {
  FoundLinks found{};
  for (std::size_t k = 0; k < n; ++k) {
    const std::uint32_t p = indices[k];
    if (p >= place.last) found.any_beyond = true;
    if (p < place.first || p >= place.last || test.parent[p] == place.root) continue;
    const float least = std::max(test.least_cosine[place.point], test.least_cosine[p]);
    if (cosine(test.normals, place.point, p) > least) out[found.num++] = p;
  }
  return found;
}

bool any_other(const std::int32_t* values, std::int32_t value, const std::uint32_t* indices, std::size_t n) {
  return std::any_of(indices, indices + n, [&](std::uint32_t i) { return values[i] != value; });
}

}  // namespace graspd::portable

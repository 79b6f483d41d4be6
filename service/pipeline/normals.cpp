// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/normals.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "service/pipeline/point_kernels.hpp"

namespace graspd {
namespace {

/// Eigenproblems solved side by side, so that the compiler can use one vector lane for each.
constexpr std::size_t kLanes = 8;
using Lanes = std::array<float, kLanes>;

struct Covariances {
  Lanes xx{}, xy{}, xz{}, yy{}, yz{}, zz{};
  Lanes minors{};  // sum of the principal minors: the product of the two larger eigenvalues where there is a
                   // plane
};

/// Covariance of N(s), divided by its trace; all zero when there is no extent.
void add_covariance(const PointCloud& cloud, std::span<const std::uint32_t> neighborhood,
                    const Eigen::Vector3f& s, Covariances& c, std::size_t lane) {
  auto [x, y, z, xx, xy, xz, yy, yz, zz] =
      point_kernels().sum_moments({s.x(), s.y(), s.z()}, cloud.x.data(), cloud.y.data(), cloud.z.data(),
                                  neighborhood.data(), neighborhood.size());
  if (neighborhood.empty()) return;
  const float per = 1.0f / static_cast<float>(neighborhood.size());
  xx -= x * x * per;
  xy -= x * y * per;
  xz -= x * z * per;
  yy -= y * y * per;
  yz -= y * z * per;
  zz -= z * z * per;
  const float trace = xx + yy + zz;
  const float scale = neighborhood.size() >= 3 && trace > 1e-20f ? 1.0f / trace : 0.0f;
  c.xx[lane] = xx * scale;
  c.xy[lane] = xy * scale;
  c.xz[lane] = xz * scale;
  c.yy[lane] = yy * scale;
  c.yz[lane] = yz * scale;
  c.zz[lane] = zz * scale;
}

/// Smallest eigenvalues of symmetric matrices of trace 1, by Newton's method on the characteristic polynomial
/// from below its smallest root, where it converges monotonically.
Lanes smallest_eigenvalues(Covariances& c) {
  Lanes root{};
  for (std::size_t k = 0; k < kLanes; ++k) {
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
  return root;
}

/// Eigenvectors for the eigenvalues: the longest cross product of two rows of C - t I, unit length, or zero.
void eigenvectors(const Covariances& c, const Lanes& t, Lanes& x, Lanes& y, Lanes& z) {
  for (std::size_t k = 0; k < kLanes; ++k) {
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
    x[k] = scale * (third ? x2 : second ? x1 : x0);
    y[k] = scale * (third ? y2 : second ? y1 : y0);
    z[k] = scale * (third ? z2 : second ? z1 : z0);
  }
}

void estimate_lanes(const PointCloud& cloud, const Neighborhoods& neighborhoods, std::size_t first,
                    std::size_t num, Normals& normals) {
  Covariances c;
  bool any = false;
  for (std::size_t k = 0; k < num; ++k) any |= neighborhoods.of(first + k).size() >= 3;
  if (!any) return;
  for (std::size_t k = 0; k < num; ++k)
    add_covariance(cloud, neighborhoods.of(first + k), cloud.point(first + k), c, k);
  Lanes x{}, y{}, z{};
  const Lanes smallest = smallest_eigenvalues(c);
  eigenvectors(c, smallest, x, y, z);
  for (std::size_t k = 0; k < num; ++k) {
    const Eigen::Vector3f to_sensor = cloud.viewpoint - cloud.point(first + k);
    const float sign = x[k] * to_sensor.x() + y[k] * to_sensor.y() + z[k] * to_sensor.z() < 0 ? -1.0f : 1.0f;
    normals.x[first + k] = sign * x[k];
    normals.y[first + k] = sign * y[k];
    normals.z[first + k] = sign * z[k];
  }
}

}  // namespace

Normals estimate_normals(const PointCloud& cloud, const Neighborhoods& neighborhoods) {
  const std::size_t n = cloud.size();
  Normals normals{std::pmr::vector<float>(n), std::pmr::vector<float>(n), std::pmr::vector<float>(n)};
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, (n + kLanes - 1) / kLanes, 128),
                    [&](const auto& range) {
                      for (std::size_t group = range.begin(); group != range.end(); ++group) {
                        const std::size_t first = group * kLanes;
                        estimate_lanes(cloud, neighborhoods, first, std::min(kLanes, n - first), normals);
                      }
                    });
  return normals;
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/point_kernels.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "service/pipeline/surface_kernels.hpp"

namespace graspd {
namespace {

constexpr std::size_t kBlock = 32;

struct Block {
  float a[kBlock], f[kBlock], z[kBlock];
  int inside[kBlock];
};

/// Plain scalars and arrays, so that the compiler can use the vectors that every processor has.
void transform(const BoxTest& box, const float* x, const float* y, const float* z, std::size_t n,
               Block& out) {
  const auto& m = box.to_local;
  const float r00 = m[0][0], r01 = m[0][1], r02 = m[0][2], t0 = box.shift[0];
  const float r10 = m[1][0], r11 = m[1][1], r12 = m[1][2], t1 = box.shift[1];
  const float r20 = m[2][0], r21 = m[2][1], r22 = m[2][2], t2 = box.shift[2];
  const float a0 = box.min[0], a1 = box.max[0], f0 = box.min[1], f1 = box.max[1], z0 = box.min[2],
              z1 = box.max[2];
  float *a = out.a, *f = out.f, *depth = out.z;
  int* inside = out.inside;
  for (std::size_t k = 0; k < n; ++k) {
    a[k] = r00 * x[k] + r01 * y[k] + r02 * z[k] + t0;
    f[k] = r10 * x[k] + r11 * y[k] + r12 * z[k] + t1;
    depth[k] = r20 * x[k] + r21 * y[k] + r22 * z[k] + t2;
    inside[k] = int{a[k] >= a0} & int{a[k] <= a1} & int{f[k] >= f0} & int{f[k] <= f1} & int{depth[k] >= z0} &
                int{depth[k] <= z1};
  }
}

std::size_t keep_inside(const BoxTest& box, const PointRange& points, std::span<const PointSpan> spans,
                        const LocalOutput& out) {
  Block block;
  std::size_t n = 0;
  for (const PointSpan& span : spans)
    for (std::size_t from = span.begin; from < span.end; from += kBlock) {
      const std::size_t size = std::min(kBlock, span.end - from);
      transform(box, points.x + from, points.y + from, points.z + from, size, block);
      for (std::size_t k = 0; k < size; ++k) {
        out.a[n] = block.a[k];
        out.f[n] = block.f[k];
        out.z[n] = block.z[k];
        out.index[n] = points.index[from + k];
        n += static_cast<std::size_t>(block.inside[k]);
      }
    }
  return n;
}

std::size_t count_inside(const BoxTest& box, const PointRange& points, std::span<const PointSpan> spans,
                         std::size_t enough) {
  Block block;
  std::size_t n = 0;
  for (auto span = spans.begin(); span != spans.end() && n <= enough; ++span)
    for (std::size_t from = span->begin; from < span->end; from += kBlock) {
      const std::size_t size = std::min(kBlock, span->end - from);
      transform(box, points.x + from, points.y + from, points.z + from, size, block);
      n += static_cast<std::size_t>(std::accumulate(block.inside, block.inside + size, 0));
    }
  return n;
}

void meet_rows(const RowLimits& limits, const CellRows& rows, std::int32_t* from, std::int32_t* to) {
  const float per_cell = 1 / limits.cell_m;
  for (std::size_t i = 0; i < rows.size; ++i) {
    const float y = (static_cast<float>(rows.y[i]) + 0.5f) * limits.cell_m;
    float x0 = limits.least[0] - limits.slope[0] * y, x1 = limits.most[0] - limits.slope[0] * y;
    for (int k = 1; k < 4; ++k) {
      x0 = std::max(x0, limits.least[k] - limits.slope[k] * y);
      x1 = std::min(x1, limits.most[k] - limits.slope[k] * y);
    }
    from[i] = std::max(0, cell_index(x0, per_cell) - rows.x[i]);
    to[i] = x0 > x1 ? 0 : std::min(rows.num_cells[i], cell_index(x1, per_cell) + 1 - rows.x[i]);
  }
}

std::size_t keep_near(const float (&p)[3], float distance_squared, const PointRange& points,
                      std::span<const PointSpan> spans, std::uint32_t* out) {
  const float px = p[0], py = p[1], pz = p[2];
  float distance[kBlock];
  std::uint32_t* end = out;
  for (const PointSpan& span : spans)
    for (std::size_t from = span.begin; from < span.end; from += kBlock) {
      const std::size_t size = std::min(kBlock, span.end - from);
      const float *x = points.x + from, *y = points.y + from, *z = points.z + from;
      for (std::size_t k = 0; k < size; ++k) {
        const float dx = px - x[k], dy = py - y[k], dz = pz - z[k];
        distance[k] = dx * dx + dy * dy + dz * dz;
      }
      for (std::size_t k = 0; k < size; ++k) {
        *end = points.index[from + k];
        end += distance[k] <= distance_squared ? 1 : 0;
      }
    }
  return static_cast<std::size_t>(end - out);
}

constexpr std::size_t kParts = 8;

void sum_parts(const float* x, const float* y, const float* z, const NeighborList& list,
               float (&part)[9][kParts]) {
  const float px = x[list.point], py = y[list.point], pz = z[list.point];
  for (std::size_t from = 0; from < list.size; from += kParts) {
    const std::size_t size = std::min(kParts, list.size - from);
    for (std::size_t k = 0; k < size; ++k) {
      const std::uint32_t i = list.indices[from + k];
      const float dx = x[i] - px, dy = y[i] - py, dz = z[i] - pz;
      part[0][k] += dx;
      part[1][k] += dy;
      part[2][k] += dz;
      part[3][k] += dx * dx;
      part[4][k] += dx * dy;
      part[5][k] += dx * dz;
      part[6][k] += dy * dy;
      part[7][k] += dy * dz;
      part[8][k] += dz * dz;
    }
  }
}

void sum_moments(const float* x, const float* y, const float* z, std::span<const NeighborList> lists,
                 MomentLanes& out) {
  out = {};
  for (std::size_t k = 0; k < lists.size(); ++k) {
    float part[9][kParts] = {};
    sum_parts(x, y, z, lists[k], part);
    float* sums[9] = {out.x, out.y, out.z, out.xx, out.xy, out.xz, out.yy, out.yz, out.zz};
    for (int m = 0; m < 9; ++m) sums[m][k] = std::accumulate(part[m], part[m] + kParts, 0.0f);
    out.count[k] = static_cast<float>(lists[k].size);
  }
}

void extend_bounds(const float* v, std::size_t n, float& low, float& high) {
  for (std::size_t i = 0; i < n; ++i) {
    if (v[i] < low) low = v[i];
    if (v[i] > high) high = v[i];
  }
}

void number_cells(const CellGrid& grid, const float* x, const float* y, const float* z, std::size_t n,
                  std::uint32_t* out) {
  const auto from_first = [&grid](float coordinate, int axis) {
    return static_cast<std::uint32_t>(cell_index(coordinate, grid.per_cell) - grid.min_cell[axis]);
  };
  for (std::size_t i = 0; i < n; ++i)
    out[i] = from_first(x[i], 0) + grid.row * from_first(y[i], 1) + grid.layer * from_first(z[i], 2);
}

CircleSums sum_circle(const CircleWeights& weights, const float* xs, const float* ys, std::size_t n) {
  double parts[9][4] = {};
  for (std::size_t i = 0; i < n; ++i) {
    const float dx = xs[i] - weights.x, dy = ys[i] - weights.y;
    const float e = (std::sqrt(dx * dx + dy * dy) - weights.radius) * weights.per_scale;
    const double w = double{1 / (1 + e * e)}, x = double{xs[i]}, y = double{ys[i]};
    const double wx = w * x, wy = w * y, wq = w * (x * x + y * y);
    const double terms[9] = {w, wx, wy, wx * x, wx * y, wy * y, wq, wq * x, wq * y};
    for (int k = 0; k < 9; ++k) parts[k][i % 4] += terms[k];
  }
  double sum[9];
  for (int k = 0; k < 9; ++k) sum[k] = parts[k][0] + parts[k][1] + parts[k][2] + parts[k][3];
  return {sum[0], sum[1], sum[2], sum[3], sum[4], sum[5], sum[6], sum[7], sum[8]};
}

ProfileSums sum_profile(const ProfileWeights& weights, const FacePoints& face) {
  const float* c = weights.c;
  float parts[14][8] = {};
  for (std::size_t i = 0; i < face.size; ++i) {
    const float s = face.s[i], a = face.a[i], z = face.z[i], ss = s * s;
    const float e = (c[0] + c[1] * s + (c[2] * ss + c[3] * a) - z) * weights.per_scale;
    const float w = 1 / (1 + e * e), ws = w * s, wss = w * ss, wa = w * a, wz = w * z;
    const float terms[14] = {w,       ws,     wss, wss * s, wss * ss, wa,     wa * s,
                             wa * ss, wa * a, wz,  wz * s,  wz * ss,  wz * a, w * (e * e)};
    for (int k = 0; k < 14; ++k) parts[k][i % 8] += terms[k];
  }
  float sum[14] = {};
  for (int k = 0; k < 14; ++k)
    for (const float part : parts[k]) sum[k] += part;
  return {sum[0], sum[1], sum[2], sum[3],  sum[4],  sum[5],  sum[6],
          sum[7], sum[8], sum[9], sum[10], sum[11], sum[12], sum[13]};
}

void find_hiders(const ViewImage& image, const Probes& places, float margin_m,
                 std::int32_t (&hiders)[kProbes]) {
  const auto& axes = image.axes;
  float u[kProbes], v[kProbes], depth[kProbes];
  for (std::size_t k = 0; k < kProbes; ++k) {
    const float dx = places.x[k] - image.origin[0], dy = places.y[k] - image.origin[1],
                dz = places.z[k] - image.origin[2];
    const float x = axes[0][0] * dx + axes[0][1] * dy + axes[0][2] * dz,
                y = axes[1][0] * dx + axes[1][1] * dy + axes[1][2] * dz;
    depth[k] = axes[2][0] * dx + axes[2][1] * dy + axes[2][2] * dz;
    u[k] = image.focal[0] * x / depth[k] + image.center[0] + 0.5f;
    v[k] = image.focal[1] * y / depth[k] + image.center[1] + 0.5f;
  }
  const auto width = static_cast<float>(image.width), height = static_cast<float>(image.height);
  for (std::size_t k = 0; k < kProbes; ++k) {
    hiders[k] = -1;
    if (!(depth[k] > 0)) continue;
    if (!(u[k] >= 0 && v[k] >= 0 && u[k] < width && v[k] < height)) {
      hiders[k] = v[k] < 0 ? image.above : v[k] >= height ? image.below : image.beside;
      continue;
    }
    const std::int32_t pixel =
        static_cast<std::int32_t>(v[k]) * image.width + static_cast<std::int32_t>(u[k]);
    if (image.depth[pixel] > 0 && image.depth[pixel] < depth[k] - margin_m) hiders[k] = image.point[pixel];
  }
}

void tag_band(const BandTags& tags, const BandPoints& points, std::int32_t* own, std::int32_t* marks) {
  const auto stride = static_cast<std::int32_t>(tags.stride());
  for (std::size_t k = 0; k < points.size; ++k)
    marks[k] = cell_index((points.f[k] - tags.first) / tags.bin, 1);
  for (std::size_t k = 0; k < points.size; ++k) {
    const std::int32_t object = tags.object_of_voxel[tags.voxel_of_point[points.index[k]]], bin = marks[k];
    own[k] = object == tags.object ? 1 : 0;
    const bool has_entry = bin >= 0 && bin < tags.num_bins;
    marks[k] = has_entry ? bin + own[k] * stride : tags.no_mark();
  }
}

std::size_t keep_depths(const BandPoints& points, const std::int32_t* own, const BandPart& part, float* out) {
  std::size_t n = 0;
  for (std::size_t k = 0; k < points.size; ++k) {
    out[n] = points.z[k];
    n += static_cast<std::size_t>(own[k] & int{points.f[k] >= part.f_min} & int{points.f[k] <= part.f_max} &
                                  int{points.z[k] >= part.z_min});
  }
  return n;
}

/// 1 where point k is within the limits.
int is_within(const BandLimits& limits, const BandPoints& points, std::size_t k) {
  const float distance = std::abs(points.f[k] - limits.middle), depth = points.z[k] - limits.top;
  return int{distance >= limits.min_distance} & int{distance <= limits.max_distance} &
         int{depth >= limits.min_depth} & int{depth <= limits.max_depth};
}

std::size_t select_band(const BandLimits& limits, const BandPoints& points, std::uint32_t* out) {
  std::size_t n = 0;
  for (std::size_t k = 0; k < points.size; ++k) {
    out[n] = static_cast<std::uint32_t>(k);
    n += static_cast<std::size_t>(is_within(limits, points, k));
  }
  return n;
}

BandCounts select_own(const BandLimits& limits, const BandPoints& points, const std::int32_t* own,
                      std::uint32_t* out) {
  BandCounts n{0, 0};
  for (std::size_t k = 0; k < points.size; ++k) {
    const int within = is_within(limits, points, k);
    out[n.own] = static_cast<std::uint32_t>(k);
    n.all += static_cast<std::size_t>(within);
    n.own += static_cast<std::size_t>(within & own[k]);
  }
  return n;
}

void extend_own(const BandLimits& limits, const BandPoints& points, const std::int32_t* own, float& low,
                float& high) {
  for (std::size_t k = 0; k < points.size; ++k) {
    if ((is_within(limits, points, k) & own[k]) == 0) continue;
    low = std::min(low, points.f[k]);
    high = std::max(high, points.f[k]);
  }
}

void mark_band(const BandLimits& limits, const BandPoints& points, const std::int32_t* marks,
               std::uint8_t* marked) {
  for (std::size_t k = 0; k < points.size; ++k)
    if (is_within(limits, points, k) != 0) marked[marks[k]] = 1;
}

}  // namespace

const PointKernels& portable_kernels() {
  using namespace portable;
  static constexpr PointKernels kKernels{
      test_workspace, copy_chosen,    keep_inside,   count_inside,   meet_rows,   keep_near,
      copy_inside,    sum_moments,    solve_planes,  count_on_plane, count_bent,  find_links,
      any_other,      list_above,     list_members,  list_unmarked,  sum_circle,  sum_profile,
      find_hiders,    sum_directions, extend_slopes, find_pixels,    first_few,   extend_bounds,
      number_cells,   count_changes,  write_runs,    count_cells,    write_cells, copy_at,
      set_means,      find_middles,   tag_band,      keep_depths,    select_band, select_own,
      extend_own,     mark_band};
  return kKernels;
}

const PointKernels& point_kernels() {
  static const PointKernels& chosen = avx2_kernels() ? *avx2_kernels() : portable_kernels();
  return chosen;
}

}  // namespace graspd

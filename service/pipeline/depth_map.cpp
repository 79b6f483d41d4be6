// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/depth_map.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "service/pipeline/cell_order.hpp"

namespace graspd {
namespace {

/// Wider views are cut off: what is outside the image counts as seen.
constexpr float kMaxSlope = 2.0f;
constexpr int kMaxSide = 1024;
/// Share of an image's columns or rows: sensors that see nothing in so many at its border see no farther
/// there.
constexpr float kBorder = 0.05f;
constexpr float kNearest = 1e-6f;  // of what hides everything [m]

Eigen::Matrix3f looking_along(const Eigen::Vector3f& forward) {
  Eigen::Matrix3f axes;
  // The optical frame's own axes for a sensor that looks along z, so that image rows stay rows.
  Eigen::Vector3f right = Eigen::Vector3f::UnitY().cross(forward);
  if (right.norm() < 0.1f) right = Eigen::Vector3f::UnitX();
  right = (right - right.dot(forward) * forward).normalized();
  axes.row(0) = right;
  axes.row(1) = forward.cross(right);
  axes.row(2) = forward;
  return axes;
}

/// Of the unit vectors from the viewpoint to the points.
Eigen::Vector3f sum_of_directions(const ViewImage& view, const PointCloud& cloud) {
  DirectionSums sums{};
  point_kernels().sum_directions(view, range_of(cloud), sums);
  const auto sum = [](const float(&parts)[8]) { return std::accumulate(parts, parts + 8, 0.0f); };
  return {sum(sums.x), sum(sums.y), sum(sums.z)};
}

/// The smallest and the largest column with a point in it.
std::pair<std::uint32_t, std::uint32_t> column_range(const ImagePixels& pixels) {
  const auto width = static_cast<std::uint32_t>(pixels.width);
  const std::uint32_t *point = pixels.of_point.data(), *end = point + pixels.of_point.size();
  std::uint32_t first = width - 1, last = 0;
  while (point != end) {
    const std::uint32_t row = *point / width * width;
    first = std::min(first, *point - row);
    point = std::lower_bound(point, end, row + width);
    last = std::max(last, *(point - 1) - row);
  }
  return {first, last};
}

}  // namespace

DepthMap::DepthMap(const PointCloud& cloud, const ImagePixels& pixels)
    : view_{{cloud.viewpoint.x(), cloud.viewpoint.y(), cloud.viewpoint.z()},
            {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
            {1, 1},
            {0, 0},
            0,
            0,
            nullptr,
            nullptr} {
  if (cloud.empty()) return;
  if (const auto camera = fit_pinhole(cloud, pixels))
    take_image(cloud, pixels, *camera);
  else
    render(cloud);
}

void DepthMap::set_size(int width, int height) {
  view_.width = width;
  view_.height = height;
  const auto size = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  depth_.resize(size);
  point_.resize(size);
  view_.depth = depth_.data();
  view_.point = point_.data();
}

/// Rows before the first point's and after the last one's are left out: nothing is seen there.
void DepthMap::take_image(const PointCloud& cloud, const ImagePixels& pixels, const PinholeModel& camera) {
  const auto width = static_cast<std::uint32_t>(pixels.width);
  const std::uint32_t max_gap = static_cast<std::uint32_t>(std::max(pixels.width, pixels.height)) / 10,
                      first_row = pixels.of_point.front() / width, last_row = pixels.of_point.back() / width;
  set_size(pixels.width, static_cast<int>(last_row - first_row) + 1);
  view_.focal[0] = camera.fx_px;
  view_.focal[1] = camera.fy_px;
  view_.center[0] = camera.cx_px;
  view_.center[1] = camera.cy_px - static_cast<float>(first_row);
  std::uint32_t next = 0;  // the first pixel that is not set
  for (std::size_t i = 0; i < cloud.size();) {
    const std::uint32_t at = pixels.of_point[i] - first_row * width;
    const std::uint32_t size = take_pixels(cloud, pixels, i, at);
    if (at != next) {
      const bool is_in_row = next % width != 0 && next / width == at / width;
      if (is_in_row && at - next < max_gap)
        close_gap(next, at);
      else
        fill(next, at, 0, kFree);
    }
    i += size;
    next = at + size;
  }
  fill(next, depth_.size(), 0, kFree);
  const auto [first_column, last_column] = column_range(pixels);
  const auto seen = static_cast<float>(last_column - first_column + 1) * static_cast<float>(view_.height);
  point_area_ = seen / (static_cast<float>(cloud.size()) * view_.focal[0] * view_.focal[1]);
  const auto is_border = [](std::uint32_t empty, int of) {
    return static_cast<float>(empty) <= kBorder * static_cast<float>(of);
  };
  view_.above = is_border(first_row, pixels.height) ? kOutOfView : kFree;
  view_.below =
      is_border(static_cast<std::uint32_t>(pixels.height) - 1 - last_row, pixels.height) ? kOutOfView : kFree;
  view_.beside = kOutOfView;
  for (std::size_t row = 0; row < depth_.size(); row += width) {
    if (is_border(first_column, pixels.width)) fill(row, row + first_column, kNearest, kOutOfView);
    if (is_border(width - 1 - last_column, pixels.width))
      fill(row + last_column + 1, row + width, kNearest, kOutOfView);
  }
}

std::uint32_t DepthMap::take_pixels(const PointCloud& cloud, const ImagePixels& pixels, std::size_t i,
                                    std::uint32_t at) {
  constexpr std::uint32_t kAtOnce = 16;
  const bool are_many =
      i + kAtOnce <= cloud.size() && pixels.of_point[i + kAtOnce - 1] == pixels.of_point[i] + kAtOnce - 1;
  const float *z = cloud.z.data() + i, origin = view_.origin[2];
  float* depth = depth_.data() + at;
  std::int32_t* point = point_.data() + at;
  const auto first = static_cast<std::int32_t>(i);
  if (!are_many) {
    *depth = *z - origin;
    *point = first;
    return 1;
  }
  for (std::uint32_t k = 0; k < kAtOnce; ++k) depth[k] = z[k] - origin;
  for (std::uint32_t k = 0; k < kAtOnce; ++k) point[k] = first + static_cast<std::int32_t>(k);
  return kAtOnce;
}

void DepthMap::render(const PointCloud& cloud) {
  const Eigen::Vector3f sum = sum_of_directions(view_, cloud);
  if (sum.norm() < 1e-3f) return;
  Eigen::Map<Eigen::Matrix<float, 3, 3, Eigen::RowMajor>>(view_.axes[0]) = looking_along(sum.normalized());

  SlopeBounds bounds{kMaxSlope, -kMaxSlope, kMaxSlope, -kMaxSlope};
  point_kernels().extend_slopes(view_, range_of(cloud), bounds);
  const float left = std::max(bounds.left, -kMaxSlope), right = std::min(bounds.right, kMaxSlope),
              top = std::max(bounds.top, -kMaxSlope), bottom = std::min(bounds.bottom, kMaxSlope);
  if (right <= left || bottom <= top) return;
  // About one pixel a point, so that a closed surface leaves few gaps and an edge stays where it is.
  // Points on nearly one ray would have pixels beyond all numbers.
  constexpr float kMinSide = 1e-6f;
  const float area = std::max((right - left) * (bottom - top), kMinSide * kMinSide);
  const float focal =
      std::min(std::sqrt(static_cast<float>(cloud.size()) / area),
               static_cast<float>(kMaxSide - 4) / std::max({right - left, bottom - top, kMinSide}));
  view_.focal[0] = view_.focal[1] = focal;
  point_area_ = 1 / (focal * focal);
  set_size(static_cast<int>(focal * (right - left)) + 3, static_cast<int>(focal * (bottom - top)) + 3);
  view_.center[0] = 1 - focal * left;
  view_.center[1] = 1 - focal * top;
  splat(cloud);
  close_gaps(static_cast<std::size_t>(std::max(view_.width, view_.height)) / 10);
}

void DepthMap::splat(const PointCloud& cloud) {
  constexpr std::size_t kBlock = 128;
  fill(0, depth_.size(), 0, kFree);
  const PointRange all = range_of(cloud);
  std::int32_t pixel[kBlock];
  float depth[kBlock];
  for (std::size_t from = 0; from < all.size; from += kBlock) {
    const PointRange block{all.x + from, all.y + from, all.z + from, nullptr,
                           std::min(kBlock, all.size - from)};
    point_kernels().find_pixels(view_, block, pixel, depth);
    for (std::size_t k = 0; k < block.size; ++k) {
      if (pixel[k] < 0) continue;
      const auto at = static_cast<std::size_t>(pixel[k]);
      if (depth_[at] != 0 && depth_[at] <= depth[k]) continue;
      depth_[at] = depth[k];
      point_[at] = static_cast<std::int32_t>(from + k);
    }
  }
}

void DepthMap::close_gaps(std::size_t max_gap) {
  const auto width = static_cast<std::size_t>(view_.width);
  for (std::size_t row = 0; row < depth_.size(); row += width) {
    const float* depth = depth_.data() + row;
    std::size_t u = 0;
    while (u < width && depth[u] == 0) ++u;
    for (;;) {
      while (u < width && depth[u] != 0) ++u;
      const std::size_t gap = u;
      while (u < width && depth[u] == 0) ++u;
      if (u == width) break;
      if (u - gap < max_gap) close_gap(row + gap, row + u);
    }
  }
}

/// Gaps take the farther of their two ends: shadows of a projector lie on what is behind.
void DepthMap::close_gap(std::size_t from, std::size_t to) {
  const std::size_t far = depth_[to] > depth_[from - 1] ? to : from - 1;
  fill(from, to, depth_[far], point_[far]);
}

void DepthMap::fill(std::size_t from, std::size_t to, float depth, std::int32_t point) {
  std::fill(depth_.data() + from, depth_.data() + to, depth);
  std::fill(point_.data() + from, point_.data() + to, point);
}

float DepthMap::ray_area(const Eigen::Vector3f& p) const {
  const Eigen::Map<const Eigen::Vector3f> forward(view_.axes[2]), origin(view_.origin);
  const float depth = forward.dot(p - origin);
  return depth * depth * point_area_;
}

std::int32_t DepthMap::hider(const Eigen::Vector3f& p, float margin_m) const {
  Probes places;
  std::fill_n(places.x, kProbes, p.x());
  std::fill_n(places.y, kProbes, p.y());
  std::fill_n(places.z, kProbes, p.z());
  std::int32_t hiders[kProbes];
  find_hiders(places, margin_m, hiders);
  return hiders[0];
}

void DepthMap::find_hiders(const Probes& places, float margin_m, std::int32_t (&hiders)[kProbes]) const {
  std::fill_n(hiders, kProbes, kFree);
  if (depth_.empty()) return;
  point_kernels().find_hiders(view_, places, margin_m, hiders);
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/image_blocks.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace graspd {
namespace {

constexpr std::size_t kMostPixels = 16;  // along the side of a block

/// Blocks of each size across a row of the image. Sizes are pixels of a camera with the mean focal length;
/// those of the sides follow where the pixels are not square.
class BlockGrid {
 public:
  BlockGrid(const PinholeModel& camera, int width, float leaf_size_m)
      : pixels_(leaf_size_m * std::sqrt(camera.fx_px * camera.fy_px)),
        width_(static_cast<std::size_t>(width)) {
    const float stretch = std::sqrt(camera.fx_px / camera.fy_px);
    column_.resize(kMostPixels * width_);
    for (std::size_t s = 0; s < kMostPixels; ++s) {
      rows_[s] = side(static_cast<float>(s + 1) / stretch);
      const std::uint32_t columns = side(static_cast<float>(s + 1) * stretch);
      for (std::size_t u = 0; u < width_; ++u)
        column_[s * width_ + u] = num_columns_ + static_cast<std::uint32_t>(u) / columns;
      num_columns_ = column_[(s + 1) * width_ - 1] + 1;
    }
  }

  /// 0 for the smallest.
  [[nodiscard]] std::size_t size_at(float depth) const {
    return static_cast<std::size_t>(std::clamp(pixels_ / depth - 0.5f, 0.0f, float{kMostPixels - 1}));
  }
  /// Number of a column of blocks among those of all sizes.
  [[nodiscard]] std::uint32_t column(std::size_t size, std::size_t u) const {
    return column_[size * width_ + u];
  }
  [[nodiscard]] std::size_t num_columns() const { return num_columns_; }
  /// Row of blocks that a row of the image belongs to.
  [[nodiscard]] std::uint32_t row(std::size_t size, std::uint32_t v) const { return v / rows_[size]; }

 private:
  static std::uint32_t side(float pixels) {
    return static_cast<std::uint32_t>(std::lround(std::clamp(pixels, 1.0f, 32768.0f)));
  }

  float pixels_;  // a leaf has this many at depth 1
  std::size_t width_;
  std::array<std::uint32_t, kMostPixels> rows_{};
  RawVector<std::uint32_t> column_;
  std::uint32_t num_columns_ = 0;
};

/// Points of one surface in one block; sums are relative to the first, so that no digits are lost far from
/// the origin.
struct Group {
  float x, y, z;
  float sum_x = 0, sum_y = 0, sum_z = 0;
  std::uint32_t size = 0;

  void add(float px, float py, float pz) {
    sum_x += px - x;
    sum_y += py - y;
    sum_z += pz - z;
    ++size;
  }
};

/// The block that points of a column of blocks fell into last, and its surfaces: the latest few.
struct OpenBlock {
  static constexpr std::uint32_t kNone = 0xffffffff;
  std::uint32_t row = kNone;
  std::array<std::uint32_t, 3> groups{kNone, kNone, kNone};
};

/// The group of the block that is near a depth; a new one where there is none.
std::uint32_t group_at(OpenBlock& block, std::uint32_t row, const Eigen::Vector3f& p, float leaf_size_m,
                       std::pmr::vector<Group>& groups) {
  if (block.row != row) block = {row, {OpenBlock::kNone, OpenBlock::kNone, OpenBlock::kNone}};
  for (const std::uint32_t g : block.groups)
    if (g != OpenBlock::kNone && std::abs(groups[g].z - p.z()) < leaf_size_m) return g;
  block.groups = {static_cast<std::uint32_t>(groups.size()), block.groups[0], block.groups[1]};
  groups.push_back({p.x(), p.y(), p.z()});
  return block.groups[0];
}

}  // namespace

Downsampled thin_by_blocks(const PointCloud& cloud, const ImagePixels& pixels, const PinholeModel& camera,
                           float leaf_size_m) {
  const auto width = static_cast<std::uint32_t>(pixels.width);
  const BlockGrid grid(camera, pixels.width, leaf_size_m);
  std::pmr::vector<OpenBlock> open(grid.num_columns());
  std::pmr::vector<Group> groups;
  groups.reserve(cloud.size());
  Downsampled result;
  result.voxel_of_point.resize(cloud.size());
  std::array<std::uint32_t, kMostPixels> block_row{};
  std::uint32_t row = 0, row_begin = 0, row_end = 0;  // of the image, and its pixels
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const std::uint32_t pixel = pixels.of_point[i];
    if (pixel >= row_end) {
      row = pixel / width;
      row_begin = row * width;
      row_end = row_begin + width;
      for (std::size_t s = 0; s < kMostPixels; ++s) block_row[s] = grid.row(s, row);
    }
    const Eigen::Vector3f p = cloud.point(i);
    const std::size_t size = grid.size_at(p.z() - cloud.viewpoint.z());
    OpenBlock& block = open[grid.column(size, pixel - row_begin)];
    const std::uint32_t g = group_at(block, block_row[size], p, leaf_size_m, groups);
    groups[g].add(p.x(), p.y(), p.z());
    result.voxel_of_point[i] = g;
  }
  PointCloud& points = result.cloud = unorganized_cloud(groups.size(), cloud.viewpoint);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const auto n = static_cast<float>(groups[g].size);
    points.x[g] = groups[g].x + groups[g].sum_x / n;
    points.y[g] = groups[g].y + groups[g].sum_y / n;
    points.z[g] = groups[g].z + groups[g].sum_z / n;
  }
  return result;
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The coarser copy of a cloud that its support is looked for in.
#pragma once
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "service/pipeline/neighborhoods.hpp"
#include "service/pipeline/normals.hpp"
#include "service/pipeline/point_cloud.hpp"

namespace graspd {

/// Normals and neighbourhoods are made of the points that need them: in a wide view most lie far below the
/// support.
class CoarseSurface {
 public:
  /// leaf_size_m: of its voxels. Neighbours are in voxels next to each other.
  CoarseSurface(const PointCloud& cloud, float leaf_size_m);

  [[nodiscard]] const PointCloud& cloud() const { return cloud_; }
  [[nodiscard]] std::size_t size() const { return cloud_.size(); }
  [[nodiscard]] float leaf_size_m() const { return voxels_.cell_m; }

  [[nodiscard]] bool has_normal(std::size_t i) const { return has_normal_[i] != 0; }
  /// Whether the normals of all points with wanted[i] != 0 are there.
  [[nodiscard]] bool has(const std::pmr::vector<std::uint8_t>& wanted) const;
  /// Makes those that are not.
  void prepare(const std::pmr::vector<std::uint8_t>& wanted);
  /// Zero where they are not there.
  [[nodiscard]] const Normals& normals() const { return normals_; }
  /// Of points with wanted[i] != 0, made anew.
  [[nodiscard]] Neighborhoods neighborhoods(const std::pmr::vector<std::uint8_t>& wanted) const;

 private:
  CellOrder voxels_;
  PointCloud cloud_;
  std::pmr::vector<std::uint8_t> has_normal_;
  Normals normals_;
};

}  // namespace graspd

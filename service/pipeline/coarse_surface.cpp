// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/coarse_surface.hpp"

#include "service/pipeline/downsample.hpp"

namespace graspd {

CoarseSurface::CoarseSurface(const PointCloud& cloud, float leaf_size_m)
    : voxels_(order_by_cell(cloud, leaf_size_m)),
      cloud_(cell_means(cloud, voxels_)),
      has_normal_(cloud_.size()),
      normals_(cloud_.size(), Eigen::Vector3f::Zero()) {}

bool CoarseSurface::has(const std::pmr::vector<std::uint8_t>& wanted) const {
  int missing = 0;
  for (std::size_t i = 0; i < size(); ++i) missing |= wanted[i] & (1 - has_normal_[i]);
  return missing == 0;
}

void CoarseSurface::prepare(const std::pmr::vector<std::uint8_t>& wanted) {
  if (has(wanted)) return;
  std::pmr::vector<std::uint8_t> skip(size());
  for (std::size_t i = 0; i < size(); ++i) {
    skip[i] = wanted[i] == 0 || has_normal_[i] != 0 ? 1 : 0;
    has_normal_[i] |= wanted[i];
  }
  estimate_normals(cloud_, adjacent_points(voxels_, skip), normals_);
}

Neighborhoods CoarseSurface::neighborhoods(const std::pmr::vector<std::uint8_t>& wanted) const {
  std::pmr::vector<std::uint8_t> skip(size());
  for (std::size_t i = 0; i < size(); ++i) skip[i] = wanted[i] == 0 ? 1 : 0;
  return adjacent_points(voxels_, skip);
}

}  // namespace graspd

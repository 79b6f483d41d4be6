// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/coarse_surface.hpp"

#include "service/pipeline/downsample.hpp"

namespace graspd {

CoarseSurface::CoarseSurface(const PointCloud& cloud, float leaf_size_m)
    : cloud_(downsample(cloud, {leaf_size_m}).cloud),
      search_(cloud_, {2 * leaf_size_m}),
      is_missing_(cloud_.size(), 1) {}

bool CoarseSurface::has(const std::pmr::vector<std::uint8_t>& wanted) const {
  int missing = 0;
  for (std::size_t i = 0; i < size(); ++i) missing |= wanted[i] & is_missing_[i];
  return missing == 0;
}

void CoarseSurface::prepare(const std::pmr::vector<std::uint8_t>& wanted) {
  if (has(wanted)) return;
  for (std::size_t i = 0; i < size(); ++i) is_missing_[i] = wanted[i] == 0 ? 1 : 0;
  neighborhoods_ = search_.find(is_missing_);
  normals_ = estimate_normals(cloud_, neighborhoods_);
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/thin_out.hpp"

#include <algorithm>

#include "service/pipeline/cell_order.hpp"

namespace graspd {

std::pmr::vector<std::uint32_t> thin_out(const PointCloud& cloud, float spacing_m) {
  const CellOrder order = order_by_cell(cloud, spacing_m);
  std::pmr::vector<std::uint32_t> chosen(order.num_cells());
  for (std::size_t c = 0; c < order.num_cells(); ++c) {
    const std::span<const std::uint32_t> cell = order.cell(c);
    Eigen::Vector3f mean = Eigen::Vector3f::Zero();
    for (const std::uint32_t i : cell) mean += cloud.point(i);
    mean /= static_cast<float>(cell.size());
    const auto nearer = [&](std::uint32_t a, std::uint32_t b) {
      return (cloud.point(a) - mean).squaredNorm() < (cloud.point(b) - mean).squaredNorm();
    };
    chosen[c] = *std::min_element(cell.begin(), cell.end(), nearer);
  }
  return chosen;
}

}  // namespace graspd

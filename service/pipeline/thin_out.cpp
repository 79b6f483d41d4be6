// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/thin_out.hpp"

#include "service/pipeline/cell_order.hpp"

namespace graspd {

std::pmr::vector<std::uint32_t> thin_out(const PointCloud& cloud, std::span<const std::uint32_t> indices,
                                         float spacing_m) {
  const CellOrder order = order_by_cell(cloud, indices, spacing_m);
  std::pmr::vector<std::uint32_t> chosen(order.num_cells());
  point_kernels().find_middles(order.of(cloud, 0, order.num_cells()), chosen.data());
  return chosen;
}

}  // namespace graspd

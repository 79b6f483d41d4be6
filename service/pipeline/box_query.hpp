// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Points of a cloud inside an oriented box, in the box's own coordinates: what the gripper's volumes are
// tested with.
#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "service/pipeline/cell_order.hpp"
#include "service/pipeline/point_cloud.hpp"

namespace graspd {

/// Points in gripper coordinates [m]: a along the major axis, f along the closing axis, z along the approach.
struct LocalPoints {
  std::vector<float> a, f, z;
  std::vector<std::uint32_t> index;  ///< into the cloud

  [[nodiscard]] std::size_t size() const { return a.size(); }
  void resize(std::size_t n) {
    a.resize(n);
    f.resize(n);
    z.resize(n);
    index.resize(n);
  }
};

class BoxQuery {
 public:
  BoxQuery() = default;
  /// All points must be finite. cell_m: side of the grid's cells, about a third of the boxes asked for.
  BoxQuery(const PointCloud& cloud, float cell_m);

  /// Points whose coordinates rotation^T (p - origin) lie in [min, max], in an order fixed by their
  /// positions. Replaces what is in out.
  void find(const Eigen::Vector3f& origin, const Eigen::Matrix3f& rotation, const Eigen::Vector3f& min,
            const Eigen::Vector3f& max, LocalPoints& out) const;

  /// Whether more than limit points lie in the box.
  [[nodiscard]] bool has_more(const Eigen::Vector3f& origin, const Eigen::Matrix3f& rotation,
                              const Eigen::Vector3f& min, const Eigen::Vector3f& max, int limit) const;

 private:
  struct Box;
  /// Calls visit(from, to) with ranges of positions that hold all points of the box; it returns false to
  /// stop.
  template <class Visit>
  void for_each_range(const Box& box, Visit visit) const;

  CellOrder order_;
  std::vector<float> x_, y_, z_;  // in the order of the cells
};

}  // namespace graspd

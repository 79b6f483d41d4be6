// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/object_outline.hpp"

#include <cmath>
#include <cstdint>

#include "service/pipeline/cell_order.hpp"

namespace graspd {
namespace {

constexpr float kSpacing = 0.008f;  // between the points that stand for the object [m]

}  // namespace

ObjectOutlines::ObjectOutlines(const PointCloud& cloud, const std::vector<std::int32_t>& object_of_point,
                               int num_objects)
    : objects_(static_cast<std::size_t>(num_objects)) {
  std::vector<PointCloud> all(objects_.size());
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (object_of_point[i] >= 0) all[static_cast<std::size_t>(object_of_point[i])].push_back(cloud.point(i));
  for (std::size_t k = 0; k < all.size(); ++k) {
    const CellOrder order = order_by_cell(all[k], kSpacing);
    for (std::size_t c = 0; c < order.num_cells(); ++c)
      objects_[k].push_back(all[k].point(order.cell(c).front()));
  }
}

bool ObjectOutlines::clearly_too_wide(const Candidate& candidate, const Gripper& gripper) const {
  const PointCloud& points = objects_[static_cast<std::size_t>(candidate.object)];
  const float half_band = 0.5f * gripper.finger_thickness_m;
  // Occupied spacings to both sides of the candidate; bit 32 is its own.
  std::uint64_t occupied = 0;
  const Eigen::Vector3f a = candidate.rotation.col(0), f = candidate.rotation.col(1),
                        z = candidate.rotation.col(2);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f d = points.point(i) - candidate.position;
    // Only what is surely within the fingers' depth, wherever the top turns out to be.
    if (std::abs(d.dot(a)) > half_band || std::abs(d.dot(z)) > 0.5f * gripper.grasp_depth_m) continue;
    const float bin = d.dot(f) / kSpacing + 32.5f;
    if (bin >= 0 && bin < 64) occupied |= std::uint64_t{1} << static_cast<int>(bin);
  }
  const auto run = [occupied](int step) {
    int last = 32;
    for (int b = 32; b >= 0 && b < 64 && std::abs(b - last) <= 2; b += step)
      if ((occupied >> b) & 1) last = b;
    return std::abs(last - 32);
  };
  return static_cast<float>(run(1) + run(-1) - 1) * kSpacing > gripper.aperture_m;
}

}  // namespace graspd

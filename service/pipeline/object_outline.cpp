// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/object_outline.hpp"

#include <tbb/parallel_for.h>

#include <cmath>
#include <cstdint>

#include "service/pipeline/cell_order.hpp"

namespace graspd {
namespace {

constexpr float kSpacing = 0.010f;  // between the points that stand for the object [m]

}  // namespace

ObjectOutlines::ObjectOutlines(const PointCloud& cloud, const ObjectPoints& points)
    : objects_(points.starts.size() - 1) {
  tbb::parallel_for(std::size_t{0}, objects_.size(), [&](std::size_t k) {
    const PointCloud object = points_at(cloud, points.of(k));
    const CellOrder order = order_by_cell(object, kSpacing);
    std::pmr::vector<std::uint32_t> first(order.num_cells());
    for (std::size_t c = 0; c < first.size(); ++c) first[c] = order.cell(c).front();
    objects_[k] = PaddedPoints(object, first);
  });
}

bool ObjectOutlines::clearly_too_wide(const Candidate& candidate, const Gripper& gripper,
                                      LocalPoints& buffer) const {
  const float half_band = 0.5f * gripper.finger_thickness_m, half_depth = 0.5f * gripper.grasp_depth_m;
  constexpr float kReach = 31.4f * kSpacing;
  // Only what is surely within the fingers' depth, wherever the top turns out to be.
  const PaddedPoints& points = objects_[static_cast<std::size_t>(candidate.object)];
  const PointSpan whole{0, static_cast<std::uint32_t>(points.size())};
  buffer.clear();
  buffer.add_inside(box_test(candidate.position, candidate.rotation, {-half_band, -kReach, -half_depth},
                             {half_band, kReach, half_depth}),
                    points.all(), {&whole, 1});
  // Occupied spacings to both sides of the candidate; bit 32 is its own.
  std::uint64_t occupied = 0;
  for (std::size_t k = 0; k < buffer.size(); ++k)
    occupied |= std::uint64_t{1} << static_cast<int>(buffer.f[k] / kSpacing + 32.5f);
  const auto run = [occupied](int step) {
    int last = 32;
    for (int b = 32; b >= 0 && b < 64 && std::abs(b - last) <= 2; b += step)
      if ((occupied >> b) & 1) last = b;
    return std::abs(last - 32);
  };
  return static_cast<float>(run(1) + run(-1) - 1) * kSpacing > gripper.aperture_m;
}

}  // namespace graspd

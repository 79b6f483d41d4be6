// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/rim_search.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "service/pipeline/cell_order.hpp"
#include "service/pipeline/near_points.hpp"
#include "service/pipeline/rim_wall.hpp"

namespace graspd {
namespace {

constexpr float kNear = 0.009f;      // around a point, where it is looked whether the surface goes on [m]
constexpr float kMinOffset = 0.25f;  // of the mean of what is near, in units of kNear: 0.42 at a straight end
constexpr float kMinUp = 0.5f;       // cosine between the rim's direction and up
constexpr float kShallow = 0.5f;     // of the grasp depth: walls that curve away below are met at their rims
constexpr float kMaxBend = 0.0008f;  // of walls that are met at the whole depth [m]

/// Where the surface with normal n ends at p: the direction in it away from the rest, if any.
std::optional<Eigen::Vector3f> end_direction(const SearchInput& in, const NearPoints& wall,
                                             const Eigen::Vector3f& p, const Eigen::Vector3f& n,
                                             NearPoints::Buffer& buffer) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  const std::span<const std::uint32_t> near = wall.within(p, kNear, buffer);
  for (const std::uint32_t i : near) sum += in.cloud.point(i) - p;
  const Eigen::Vector3f offset = (sum - sum.dot(n) * n) / static_cast<float>(near.size());
  if (offset.norm() < kMinOffset * kNear) return std::nullopt;
  return -offset.normalized();
}

/// One of the points a cell, the highest.
std::pmr::vector<std::uint32_t> highest_points(const SearchInput& in, std::span<const std::uint32_t> points,
                                               const Eigen::Vector3f& up, float cell_m) {
  const CellOrder order = order_by_cell(in.cloud, points, cell_m);
  std::pmr::vector<std::uint32_t> chosen(order.num_cells());
  for (std::size_t c = 0; c < chosen.size(); ++c) {
    const std::span<const std::uint32_t> cell = order.cell(c);
    const auto lower = [&](std::uint32_t a, std::uint32_t b) {
      return up.dot(in.cloud.point(a)) < up.dot(in.cloud.point(b));
    };
    chosen[c] = *std::max_element(cell.begin(), cell.end(), lower);
  }
  return chosen;
}

/// Where a surface of an object ends upwards.
struct RimPlace {
  Rim rim;
  std::int32_t segment, object;
};

std::pmr::vector<RimPlace> find_places(const SearchInput& in, const NearPoints& wall,
                                       std::span<const std::uint32_t> points, const Eigen::Vector3f& up,
                                       float spacing_m) {
  std::pmr::vector<RimPlace> places;
  NearPoints::Buffer buffer;
  for (const std::uint32_t k : highest_points(in, points, up, spacing_m)) {
    const Eigen::Vector3f p = in.cloud.point(k), n = in.normals.at(k);
    if (in.segments.of_point[k] < 0 || n.isZero() || up.cross(n).norm() < kMinUp) continue;
    const std::optional<Eigen::Vector3f> end = end_direction(in, wall, p, n, buffer);
    if (end && end->dot(up) >= kMinUp)
      places.push_back({{p, n, *end}, in.segments.of_point[k], in.objects.of_point[k]});
  }
  return places;
}

/// With the fingertips at the whole depth and less deep, where the sensor sees the side that the hand comes
/// from.
void add_candidates(const SearchInput& in, const RimPlace& place, const RimWall& wall, const Gripper& gripper,
                    const HandleSearchConfig& config, std::pmr::vector<Candidate>& out) {
  const Eigen::Vector3f to_sensor = (in.cloud.viewpoint - place.rim.p).normalized();
  for (const float depth_m : {gripper.grasp_depth_m, kShallow * gripper.grasp_depth_m}) {
    if (depth_m == gripper.grasp_depth_m && wall.bend_m(depth_m) > kMaxBend) continue;
    const Eigen::Matrix3f axes = wall.gripper_axes(0.5f * depth_m);
    if (-axes.col(2).dot(to_sensor) >= config.min_facing_cosine)
      out.push_back({place.rim.p, axes, place.segment, place.object, depth_m, axes.col(1), wall.error_rad()});
  }
}

}  // namespace

std::pmr::vector<Candidate> rim_candidates(const SearchInput& in, std::size_t object, const Gripper& gripper,
                                           const HandleSearchConfig& config) {
  std::pmr::vector<Candidate> candidates;
  const std::span<const std::uint32_t> points = in.object_points.of(object);
  if (points.empty()) return candidates;
  const NearPoints wall(in.cloud, points);
  const Eigen::Vector3f up =
      in.support ? in.support->plane.normal : (in.cloud.viewpoint - in.objects.center[object]).normalized();
  const auto places = find_places(in, wall, points, up, 0.5f * config.seed_spacing_m);
  if (places.empty()) return candidates;
  const std::optional<VesselAxis> axis = vessel_axis(in, points, up);
  std::pmr::vector<std::optional<RimWall>> walls(places.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, places.size(), 4), [&](const auto& range) {
    NearPoints::Buffer buffer;
    for (std::size_t k = range.begin(); k != range.end(); ++k)
      walls[k] = RimWall::fit(in, wall.within(places[k].rim.p, RimWall::kReach, buffer), places[k].rim, axis);
  });
  for (std::size_t k = 0; k < places.size(); ++k)
    if (walls[k]) add_candidates(in, places[k], *walls[k], gripper, config, candidates);
  return candidates;
}

}  // namespace graspd

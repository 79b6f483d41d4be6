// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/far_sides.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "service/pipeline/round_body.hpp"
#include "service/pipeline/surfaces.hpp"

namespace graspd {
namespace {

constexpr float kSpacing = 0.006f;  // between points around the axis [m]
constexpr float kBehind = 0.008f;   // that a hidden place is behind what is seen, or a free one before it [m]
constexpr float kInside = 0.003f;   // a wall, where it is looked through: past its limbs the sensor sees [m]
constexpr float kMostFreeShare = 0.15f;

struct HiddenWall {
  std::pmr::vector<Eigen::Vector3f> points, normals;
};

/// The places of a wall from one on, so far inside it; at its end the last one again.
Probes probes(const HiddenWall& wall, std::size_t from, float inside_m) {
  Probes places;
  for (std::size_t k = 0; k < kProbes; ++k) {
    const std::size_t i = std::min(from + k, wall.points.size() - 1);
    const Eigen::Vector3f p = wall.points[i] - inside_m * wall.normals[i];
    places.x[k] = p.x();
    places.y[k] = p.y();
    places.z[k] = p.z();
  }
  return places;
}

/// What of the body's wall faces away from the sensor or is behind others; nothing where too much of it is
/// seen through.
HiddenWall hidden_wall(const RoundBody& body, const DepthMap& depth_map, const Eigen::Vector3f& viewpoint) {
  HiddenWall wall, hidden;
  const Eigen::Vector3f x = body.axis.unitOrthogonal(), y = body.axis.cross(x);
  for (const RoundSlice& slice : body.slices) {
    const float around = 2 * std::numbers::pi_v<float> * slice.radius_m;
    const int n = std::max(8, static_cast<int>(around / kSpacing));
    const float upright = std::sqrt(std::max(0.0f, 1 - slice.lean * slice.lean));
    for (int k = 0; k < n; ++k) {
      const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(k) / static_cast<float>(n);
      const Eigen::Vector3f out = std::cos(angle) * x + std::sin(angle) * y;
      wall.points.emplace_back(body.center + slice.along_m * body.axis + slice.radius_m * out);
      wall.normals.emplace_back(upright * out + slice.lean * body.axis);
    }
  }
  std::size_t free = 0;
  for (std::size_t from = 0; from < wall.points.size(); from += kProbes) {
    const Probes places = probes(wall, from, 0), inside = probes(wall, from, kInside);
    std::int32_t behind[kProbes], near[kProbes];
    depth_map.find_hiders(places, kBehind, behind);
    depth_map.find_hiders(inside, -kBehind, near);
    for (std::size_t k = 0; k < std::min(kProbes, wall.points.size() - from); ++k) {
      free += near[k] == DepthMap::kFree ? 1 : 0;
      const Eigen::Vector3f sight = wall.points[from + k] - viewpoint;
      if (behind[k] == DepthMap::kFree && wall.normals[from + k].dot(sight) <= 0) continue;
      hidden.points.push_back(wall.points[from + k]);
      hidden.normals.push_back(wall.normals[from + k]);
    }
  }
  const float share =
      static_cast<float>(free) / static_cast<float>(std::max<std::size_t>(1, wall.points.size()));
  return share > kMostFreeShare ? HiddenWall{} : hidden;
}

BoundingBall bound(std::span<const Eigen::Vector3f> points) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& p : points) box.extend(p);
  return {box.center(), 0.5f * box.diagonal().norm()};
}

/// Parts of points of which the first is number first.
void add_parts(std::span<const Eigen::Vector3f> points, std::size_t first,
               std::pmr::vector<FarSides::Part>& parts) {
  constexpr std::size_t kMost = 96;
  for (std::size_t from = 0; from < points.size(); from += kMost) {
    const std::span<const Eigen::Vector3f> part = points.subspan(from, std::min(kMost, points.size() - from));
    const auto begin = static_cast<std::uint32_t>(first + from);
    parts.push_back({bound(part), {begin, begin + static_cast<std::uint32_t>(part.size())}});
  }
}

bool may_meet(const BoxTest& box, const BoundingBall& ball) {
  for (int i = 0; i < 3; ++i) {
    const float* axis = box.to_local[i];
    const float at =
        axis[0] * ball.center.x() + axis[1] * ball.center.y() + axis[2] * ball.center.z() + box.shift[i];
    if (at + ball.radius < box.min[i] || at - ball.radius > box.max[i]) return false;
  }
  return true;
}

}  // namespace

template <class Visit>
void FarSides::for_each_near(const BoxTest& box, Visit visit) const {
  for (const Wall& wall : walls) {
    if (!may_meet(box, wall.bounds)) continue;
    for (std::uint32_t k = wall.first_part; k < wall.end_part; ++k)
      if (may_meet(box, parts[k].bounds) && !visit(parts[k])) return;
  }
}

void FarSides::add_inside(const BoxTest& box, std::uint32_t first_index, LocalPoints& out) const {
  const std::size_t before = out.size();
  std::array<PointSpan, 32> spans;
  std::size_t n = 0;
  for_each_near(box, [&](const Part& part) {
    spans[n++] = part.points;
    if (n == spans.size()) out.add_inside(box, padded.all(), {spans.data(), std::exchange(n, 0)});
    return true;
  });
  if (n > 0) out.add_inside(box, padded.all(), {spans.data(), n});
  for (std::size_t k = before; k < out.size(); ++k) out.index[k] += first_index;
}

bool FarSides::has_more(const BoxTest& box, int limit) const {
  const auto most = static_cast<std::size_t>(limit);
  std::size_t n = 0;
  for_each_near(box, [&](const Part& part) {
    n += point_kernels().count_inside(box, padded.all(), {&part.points, 1}, most);
    return n <= most;
  });
  return n > most;
}

FarSides find_far_sides(const Surfaces& surfaces, const DepthMap& depth_map) {
  const Objects& objects = surfaces.objects;
  std::pmr::vector<std::pmr::vector<std::uint32_t>> points(static_cast<std::size_t>(objects.num_objects));
  for (std::size_t s = 0; s < objects.of_segment.size(); ++s) {
    auto& own = points[static_cast<std::size_t>(objects.of_segment[s])];
    const std::pmr::vector<std::uint32_t>& more = surfaces.segments.list[s].points;
    own.insert(own.end(), more.begin(), more.end());
  }
  std::optional<Eigen::Vector3f> up;
  if (surfaces.support) up = surfaces.support->plane.normal;
  std::pmr::vector<HiddenWall> walls(static_cast<std::size_t>(objects.num_objects));
  tbb::parallel_for(std::size_t{0}, walls.size(), [&](std::size_t k) {
    if (const auto body = fit_round_body(surfaces.cloud, surfaces.normals, points[k], up))
      walls[k] = hidden_wall(*body, depth_map, surfaces.cloud.viewpoint);
  });
  FarSides sides;
  sides.voxel_of_point = surfaces.voxel_of_point;
  sides.voxel_of_sparse = surfaces.sparse.voxel;
  for (std::size_t s = objects.of_segment.size(); s-- > 0;) {
    HiddenWall& wall = walls[static_cast<std::size_t>(objects.of_segment[s])];
    if (wall.points.empty()) continue;
    const auto first_part = static_cast<std::uint32_t>(sides.parts.size());
    add_parts(wall.points, sides.cloud.size(), sides.parts);
    sides.walls.push_back({bound(wall.points), first_part, static_cast<std::uint32_t>(sides.parts.size())});
    for (std::size_t i = 0; i < wall.points.size(); ++i) {
      sides.cloud.push_back(wall.points[i]);
      sides.normals.x.push_back(wall.normals[i].x());
      sides.normals.y.push_back(wall.normals[i].y());
      sides.normals.z.push_back(wall.normals[i].z());
      sides.voxel_of_point.push_back(surfaces.segments.list[s].points.front());
      sides.voxel_of_sparse.push_back(surfaces.segments.list[s].points.front());
    }
    wall = {};
  }
  std::pmr::vector<std::uint32_t> all(sides.cloud.size());
  std::iota(all.begin(), all.end(), 0u);
  sides.padded = PaddedPoints(sides.cloud, all);
  return sides;
}

}  // namespace graspd

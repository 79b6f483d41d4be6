// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/graspable_solids.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "client/evaluate/disturbance.hpp"

namespace graspd {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kRadians = std::numbers::pi / 180;

/// The extent of matter along the closing axis.
struct Extent {
  double low = 0, high = 0;
  [[nodiscard]] double width() const { return high - low; }
};

/// How far matter goes on from a point inside it; limit when that far or more.
double run_of_matter(const Solid& solid, const Vector3d& from, const Vector3d& direction, double limit) {
  constexpr double kStep = 2e-4;
  double s = 0;
  while (s < limit) {
    const double distance = signed_distance_in_solid(solid, from + s * direction);
    if (distance > 0) return s;
    s += std::max(kStep, -distance);
  }
  return limit;
}

/// Poses of one object, until enough of them hold.
class Search {
 public:
  Search(const SolidJudge& judge, const GraspSearchConfig& config, const VisibleObject& object,
         const Vector3d& eye)
      : judge_(judge),
        config_(config),
        object_(object),
        solid_(judge.probe().scene().solids[object.solid]),
        T_solid_world_(solid_.T_world_solid.inverse()),
        eye_(eye) {}

  std::pmr::vector<Handle> run() {
    const std::size_t n = object_.spots.size();
    const std::size_t stride = n / static_cast<std::size_t>(config_.max_spots) + 1;
    // Far spots first: scattered ones find a place that holds sooner than neighbours.
    constexpr std::size_t kScatter = 5;
    for (std::size_t first = 0; first < kScatter; ++first)
      for (std::size_t i = first * stride; i < n && !done(); i += kScatter * stride)
        try_spot(object_.spots[i]);
    return std::move(poses_);
  }

 private:
  [[nodiscard]] bool done() const { return static_cast<int>(poses_.size()) >= config_.min_poses; }

  void try_spot(const SurfaceSpot& spot) {
    const Vector3d up = Vector3d::UnitZ(), back = (eye_ - spot.point).normalized();
    const Vector3d& normal = spot.normal;
    const std::array<Vector3d, 6> ways{normal, up, back, normal + up, normal + back, up + back};
    const double limit = std::cos(kRadians * config_.max_behind_deg);
    for (const Vector3d& way : ways) {
      if (way.norm() < 0.1 || way.normalized().dot(back) <= limit) continue;
      for (int turn = 0; turn < config_.closing_directions && !done(); ++turn)
        try_pose(spot.point, way.normalized(), std::numbers::pi * turn / config_.closing_directions);
    }
  }

  void try_pose(const Vector3d& point, const Vector3d& way_back, double turn_rad) {
    const Vector3d approach = -way_back;
    const Vector3d y = Eigen::AngleAxisd(turn_rad, approach) * approach.unitOrthogonal();
    Isometry3d T_world_hand = Isometry3d::Identity();
    T_world_hand.linear() << y.cross(approach), y, approach;
    const double l = static_cast<double>(judge_.gripper().grasp_depth_m);
    for (const double share : {1.0, 0.65, 0.35}) {
      if (done()) return;
      T_world_hand.translation() = point;
      const double depth = share * l;
      for (const auto& extent : {between_walls(T_world_hand, depth), across(T_world_hand, depth)})
        if (extent && !done()) try_extent(T_world_hand, depth, *extent);
    }
  }

  void try_extent(const Isometry3d& T_world_spot, double depth, const Extent& extent) {
    const double l = static_cast<double>(judge_.gripper().grasp_depth_m);
    Handle handle;
    handle.rotation = T_world_spot.linear().cast<float>();
    handle.position = (T_world_spot * Vector3d(0, 0.5 * (extent.low + extent.high), depth - l)).cast<float>();
    handle.width_m = static_cast<float>(extent.width());
    const SolidVerdict verdict = judge_.judge(handle);
    if (!verdict.holds() || verdict.solid != object_.solid) return;
    if (undisturbed(judge_, handle, object_.solid) >= config_.min_undisturbed) poses_.push_back(handle);
  }

  /// Of the matter below the spot, out to where it ends on both sides: walls as well as whole objects.
  [[nodiscard]] std::optional<Extent> between_walls(const Isometry3d& T_world_spot, double depth) const {
    const Isometry3d T = T_solid_world_ * T_world_spot;
    const Vector3d y = T.linear().col(1);
    std::optional<Extent> sum;
    const double half = 0.45 * double(judge_.gripper().finger_thickness_m);
    for (const double x : {0.0, -half, half}) {
      for (const double z : {0.5 * depth, 0.15 * depth, 0.95 * depth}) {
        const Vector3d from = T * Vector3d(x, 0, z);
        if (signed_distance_in_solid(solid_, from) > 0) continue;
        const double limit = double(judge_.gripper().aperture_m);
        const Extent one{-run_of_matter(solid_, from, -y, limit), run_of_matter(solid_, from, y, limit)};
        sum = sum ? Extent{std::min(sum->low, one.low), std::max(sum->high, one.high)} : one;
        if (sum->width() >= limit) return std::nullopt;
      }
    }
    return sum;
  }

  /// Of a hollow object from outside to outside.
  [[nodiscard]] std::optional<Extent> across(const Isometry3d& T_world_spot, double depth) const {
    if (!solid_.cavity) return std::nullopt;
    const Isometry3d T = T_solid_world_ * T_world_spot;
    const Vector3d y = T.linear().col(1);
    const double far = 2 * double(judge_.gripper().aperture_m);
    std::optional<Extent> sum;
    for (const double z : {0.5 * depth, 0.95 * depth}) {
      const auto low = cast_in_solid(solid_, {T * Vector3d(0, -far, z), y});
      const auto high = cast_in_solid(solid_, {T * Vector3d(0, far, z), -y});
      if (!low || !high) continue;
      const Extent one{low->t - far, far - high->t};
      sum = sum ? Extent{std::min(sum->low, one.low), std::max(sum->high, one.high)} : one;
    }
    if (sum && sum->width() >= double(judge_.gripper().aperture_m)) return std::nullopt;
    return sum;
  }

  const SolidJudge& judge_;
  const GraspSearchConfig& config_;
  const VisibleObject& object_;
  const Solid& solid_;
  Isometry3d T_solid_world_;
  Vector3d eye_;
  std::pmr::vector<Handle> poses_;
};

}  // namespace

int undisturbed(const SolidJudge& judge, const Handle& handle_world, std::size_t solid) {
  const auto others = disturbed(handle_world);
  return static_cast<int>(std::count_if(others.begin(), others.end(), [&](const Handle& handle) {
    const SolidVerdict verdict = judge.judge(handle);
    return verdict.holds() && verdict.solid == solid;
  }));
}

std::vector<GraspableSolid> graspable_solids(const SolidJudge& judge, const DepthFrame& frame,
                                             const Isometry3d& T_world_camera,
                                             const GraspSearchConfig& config) {
  const Scene& scene = judge.probe().scene();
  auto objects = visible_objects(scene, frame, T_world_camera, config.spot_spacing_m);
  std::erase_if(objects, [&](const VisibleObject& object) {
    return object.pixels < config.min_pixels || object.surface_m2 < config.min_surface_m2;
  });
  std::vector<GraspableSolid> result(objects.size());
  tbb::parallel_for(std::size_t{0}, objects.size(), [&](std::size_t i) {
    const VisibleObject& object = objects[i];
    Search search(judge, config, object, T_world_camera.translation());
    result[i] = {object.solid, scene.solids[object.solid].label, object.pixels, search.run(), false};
    result[i].graspable = static_cast<int>(result[i].poses.size()) >= config.min_poses;
  });
  return result;
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/graspable_search.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "client/common/handle_csv.hpp"
#include "client/common/text.hpp"
#include "client/evaluate/disturbance.hpp"
#include "client/evaluate/grip_geometry.hpp"
#include "client/evaluate/profile_fit.hpp"

namespace graspd {
namespace {

constexpr float kSeedSpacing = 0.015f;
constexpr float kSurfaceRadius = 0.012f;  // of the normals at seeds
constexpr int kDirections = 12;           // closing axes over half a turn
constexpr float kCell = 0.02f;
constexpr std::size_t kMinPoints = 15;

using Points = std::vector<Eigen::Vector3f>;

Points points_of(const LabelScene& scene, int object) {
  Points points;
  for (std::size_t i = 0; i < scene.cloud().size(); ++i)
    if (scene.object_of(static_cast<std::uint32_t>(i)) == object) points.push_back(scene.cloud().point(i));
  return points;
}

/// No two closer than the spacing, in the order of the points.
Points spread(const Points& points) {
  Points seeds;
  for (const Eigen::Vector3f& p : points) {
    const auto near = [&](const Eigen::Vector3f& s) { return (s - p).norm() < kSeedSpacing; };
    if (std::none_of(seeds.begin(), seeds.end(), near)) seeds.push_back(p);
  }
  return seeds;
}

/// One object and how the sensor and the support see it.
struct Search {
  const LabelScene& scene;
  const Gripper& gripper;
  int object;
  PointCloud cloud;  // the object alone
  BoxQuery query;
};

/// Against the approaches worth trying at a seed.
Points outward_directions(const Search& search, const Eigen::Vector3f& seed) {
  const Eigen::Vector3f to_view = (search.scene.cloud().viewpoint - seed).normalized();
  Points directions{to_view};
  LocalPoints near;
  const Eigen::Vector3f reach = Eigen::Vector3f::Constant(kSurfaceRadius);
  search.query.find(seed, Eigen::Matrix3f::Identity(), -reach, reach, near);
  Points patch;
  for (std::size_t i = 0; i < near.size(); ++i) patch.emplace_back(near.a[i], near.f[i], near.z[i]);
  const auto normal = plane_normal(patch, search.scene.cloud().viewpoint - seed);
  if (normal) directions.push_back(*normal);
  const auto& support = search.scene.support();
  if (support) directions.push_back(support->normal);
  const std::size_t single = directions.size();
  for (std::size_t i = 0; i < single; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Eigen::Vector3f sum = directions[i] + directions[j];
      if (sum.norm() > 0.1f) directions.push_back(sum.normalized());
    }
  return directions;
}

Eigen::Matrix3f gripper_axes(const Eigen::Vector3f& outward, float angle) {
  const Eigen::Vector3f approach = -outward;
  const Eigen::Vector3f any = approach.unitOrthogonal();
  Eigen::Matrix3f rotation;
  rotation.col(1) = std::cos(angle) * any + std::sin(angle) * approach.cross(any);
  rotation.col(2) = approach;
  rotation.col(0) = rotation.col(1).cross(approach);
  return rotation;
}

/// Puts the handle on the object's top, in the middle of what the jaws would close on.
std::optional<Handle> fitted(const Search& search, const Eigen::Vector3f& seed,
                             const Eigen::Matrix3f& rotation) {
  Handle handle;
  handle.position = seed;
  handle.rotation = rotation;
  const float half = search.gripper.finger_thickness_m / 2, wide = search.gripper.aperture_m;
  LocalPoints near;
  for (int pass = 0; pass < 2; ++pass) {
    search.query.find(handle.position, rotation, {-half, -wide, -wide},
                      {half, wide, search.gripper.grasp_depth_m}, near);
    if (near.size() < kMinPoints) return std::nullopt;
    const auto [left, right] = std::minmax_element(near.f.begin(), near.f.end());
    const float top = *std::min_element(near.z.begin(), near.z.end());
    handle.width_m = *right - *left;
    handle.position += rotation * Eigen::Vector3f(0, (*left + *right) / 2, top);
  }
  if (handle.width_m > search.gripper.aperture_m) return std::nullopt;
  return handle;
}

bool is_steady(const Search& search, const Handle& handle) {
  const Verdict verdict = judge(search.scene, search.gripper, handle);
  return verdict.valid() && verdict.object == search.object &&
         valid_disturbances(search.scene, search.gripper, handle, kMinSteadyPoses) >= kMinSteadyPoses;
}

int count_poses(const LabelScene& scene, const Gripper& gripper, int object) {
  const Points points = points_of(scene, object);
  Search search{scene, gripper, object, {}, {}};
  for (const Eigen::Vector3f& p : points) search.cloud.push_back(p);
  search.query = BoxQuery(search.cloud, kCell);
  int poses = 0;
  for (const Eigen::Vector3f& seed : spread(points)) {
    for (const Eigen::Vector3f& outward : outward_directions(search, seed)) {
      for (int k = 0; k < kDirections; ++k) {
        const float angle = static_cast<float>(k) * std::numbers::pi_v<float> / kDirections;
        const auto handle = fitted(search, seed, gripper_axes(outward, angle));
        if (handle && is_steady(search, *handle) && ++poses == kMinGraspablePoses) return poses;
      }
    }
  }
  return poses;
}

}  // namespace

std::vector<GraspableObject> find_graspable(const LabelScene& scene, const Gripper& gripper, int min_points) {
  std::vector<GraspableObject> result;
  for (const LabelScene::Object& object : scene.objects())
    if (object.points >= min_points) result.push_back({object.id, object.points, 0});
  tbb::parallel_for(std::size_t{0}, result.size(),
                    [&](std::size_t i) { result[i].poses = count_poses(scene, gripper, result[i].object); });
  return result;
}

std::string graspable_csv_header() {
  return "frame,object,points,poses\n";
}

std::string graspable_csv_rows(const std::string& frame, const std::vector<GraspableObject>& objects) {
  std::string text;
  for (const GraspableObject& o : objects)
    text += csv_cell(frame) + printed(",%d,%d,%d\n", o.object, o.points, o.poses);
  return text;
}

}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/thin_wall.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "client/simulate/depth_camera.hpp"
#include "service/pipeline/detect_handles.hpp"
#include "service/pipeline/rim_search.hpp"
#include "service/pipeline/surfaces.hpp"
#include "service/pipeline/workspace_filter.hpp"

namespace graspd {
namespace {

constexpr float kTop = 0.002f;

/// Points of a face f(a, z) between the jaws, with noise along f [m].
struct Face {
  LocalPoints local;
  std::pmr::vector<std::uint32_t> between;

  template <class F>
  explicit Face(F f, float noise_m = 0) {
    PointCloud cloud;
    std::mt19937 random(3);
    std::normal_distribution<float> noise(0, 1);
    for (float a = -0.0095f; a < 0.01f; a += 0.002f)
      for (float z = kTop; z < 0.03f; z += 0.002f) cloud.push_back({a, f(a, z) + noise_m * noise(random), z});
    std::pmr::vector<std::uint32_t> all(cloud.size());
    std::iota(all.begin(), all.end(), 0u);
    const PaddedPoints padded(cloud, all);
    const PointSpan whole{0, static_cast<std::uint32_t>(cloud.size())};
    const Eigen::Vector3f far = Eigen::Vector3f::Constant(1);
    local.add_inside(box_test(Eigen::Vector3f::Zero(), Eigen::Matrix3f::Identity(), -far, far), padded.all(),
                     {&whole, 1});
    between = all;
  }
  [[nodiscard]] WallShape fitted() const { return fit_wall(local, between, kTop, {}); }
};

float angle_deg(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  return std::acos(std::min(1.0f, a.dot(b))) * 57.2958f;
}

TEST(FitWall, APlaneHasItsNormalAndNoBend) {
  for (const float tilt_a : {-0.2f, 0.0f, 0.15f})
    for (const float tilt_z : {-0.1f, 0.0f, 0.2f}) {
      const WallShape wall =
          Face([&](float a, float z) { return 0.004f + tilt_a * a + tilt_z * z; }).fitted();
      EXPECT_LT(angle_deg(wall.normal, Eigen::Vector3f(-tilt_a, 1, -tilt_z).normalized()), 0.3f);
      EXPECT_LT(wall.bend_m, 1e-4f);
    }
}

TEST(FitWall, TheBendIsTheRiseOfTheArc) {
  for (const float radius : {0.04f, 0.08f}) {
    const auto arc = [radius](float, float z) {
      const float below = z - 0.018f;  // the middle from below the edge to the fingertips
      return std::sqrt(radius * radius - below * below) - radius;
    };
    const float rise = radius - std::sqrt(radius * radius - 0.012f * 0.012f);
    EXPECT_NEAR(Face(arc).fitted().bend_m, rise, 0.1f * rise);
  }
}

TEST(FitWall, WhatIsRoundAboutTheApproachIsNotBent) {
  const WallShape wall = Face([](float a, float) { return -a * a / 0.08f; }).fitted();
  EXPECT_LT(wall.bend_m, 1e-4f);
  EXPECT_LT(angle_deg(wall.normal, Eigen::Vector3f::UnitY()), 0.5f);
}

TEST(FitWall, NoiseOfASensorTurnsItByLittle) {
  const WallShape wall = Face([](float a, float z) { return 0.1f * a - 0.1f * z; }, 0.0015f).fitted();
  EXPECT_LT(angle_deg(wall.normal, Eigen::Vector3f(-0.1f, 1, 0.1f).normalized()), 2.5f);
  EXPECT_LT(wall.bend_m, 0.0008f);
}

TEST(FitWall, OfNothingItIsSquareToTheJaws) {
  Face face([](float, float) { return 0.0f; });
  face.between.clear();
  EXPECT_EQ(face.fitted().normal, Eigen::Vector3f::UnitY());
  EXPECT_EQ(face.fitted().bend_m, 0);
}

/// A half ball, open at the top, on a table.
Scene bowl_on_table(double radius, double wall) {
  Solid table;
  table.label = kLabelSupport;
  table.parts.emplace_back(Box{Eigen::Vector3d(0, 0, -0.01), Eigen::Vector3d(0.4, 0.4, 0.01)});
  Solid bowl;
  bowl.label = object_label(kFirstObject);
  bowl.parts.emplace_back(BallSlice{radius, -radius, 0});
  bowl.cavity = Ball{Eigen::Vector3d::Zero(), radius - wall};
  bowl.T_world_solid.translation() = Eigen::Vector3d(0, 0, radius);
  return {{table, bowl}};
}

/// The bowl as a camera above the table's edge sees it.
PointCloud seen_bowl(double radius, const Eigen::Isometry3d& T_world_camera) {
  const Scene scene = bowl_on_table(radius, 0.005);
  return to_cloud(render(scene, {640, 480, 525, 525, 319.5, 239.5}, T_world_camera)).cloud;
}

TEST(ThinWall, ABentOneIsNeverMetAtTheWholeDepth) {
  const WorkspaceResult kept = filter_workspace(seen_bowl(0.07, look_at({0, -0.4, 0.45}, {0, 0, 0.03})), {});
  const Surfaces s = find_surfaces(kept.cloud, {}, [](std::string_view) {});
  const ObjectPoints points = points_by_object(s.objects);
  const SearchInput input{s.cloud, s.normals, s.segments, s.objects, points, s.support};
  const Gripper gripper;
  std::size_t num = 0;
  for (std::size_t object = 0; object < points.starts.size() - 1; ++object)
    for (const Candidate& candidate : rim_candidates(input, object, gripper, {})) {
      ++num;
      EXPECT_LT(candidate.depth_m, gripper.grasp_depth_m);
    }
  EXPECT_GT(num, 10u);
}

TEST(ThinWall, ABowlIsHeldByItsRimLessDeepThanTheHandReaches) {
  constexpr double kRadius = 0.07;
  const Gripper gripper;
  const Eigen::Isometry3d T_world_camera = look_at({0, -0.4, 0.45}, {0, 0, 0.03});
  const Detection found = detect_handles(seen_bowl(kRadius, T_world_camera), gripper, {});
  ASSERT_FALSE(found.handles.empty());
  for (const Handle& handle : found.handles) {
    const Eigen::Vector3d p = T_world_camera * handle.position.cast<double>();
    const Eigen::Matrix3d r = T_world_camera.linear() * handle.rotation.cast<double>();
    const double tips = p.z() + double(gripper.grasp_depth_m) * r(2, 2);
    EXPECT_LT(handle.width_m, 0.011f);
    EXPECT_GT(tips, kRadius - 0.022) << "further down the wall bends away";
    EXPECT_LT(tips, kRadius - 0.010);
    const Eigen::Vector3d outwards = Eigen::Vector3d(p.x(), p.y(), 0).normalized();
    EXPECT_GT(std::abs(r.col(1).dot(outwards)), 0.95) << "across the wall";
  }
}

}  // namespace
}  // namespace graspd

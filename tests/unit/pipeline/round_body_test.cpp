// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/round_body.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "service/pipeline/surfaces.hpp"
#include "tests/support/clouds.hpp"
#include "tests/support/scene_gallery.hpp"

namespace graspd {
namespace {

/// Turns every normal on its own, about each axis by so much (standard deviation).
void turn_normals(Normals& normals, float deviation_rad) {
  std::mt19937 random(1);
  std::normal_distribution<float> noise(0, deviation_rad);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const Eigen::Vector3f turn(noise(random), noise(random), noise(random));
    const Eigen::Vector3f n = (normals.at(i) + turn.cross(normals.at(i))).normalized();
    normals.x[i] = n.x();
    normals.y[i] = n.y();
    normals.z[i] = n.z();
  }
}

/// The body of the object with the most points, of normals that are off by so much.
std::optional<RoundBody> body_of(const PointCloud& cloud, float normals_off_rad = 0) {
  Surfaces surfaces = find_surfaces(finite_points(cloud), {}, [](std::string_view) {});
  if (normals_off_rad > 0) turn_normals(surfaces.normals, normals_off_rad);
  const ObjectPoints points = points_by_object(surfaces.objects);
  std::span<const std::uint32_t> most;
  for (int k = 0; k < surfaces.objects.num_objects; ++k)
    if (const auto own = points.of(static_cast<std::size_t>(k)); own.size() > most.size()) most = own;
  std::optional<Eigen::Vector3f> up;
  if (surfaces.support) up = surfaces.support->plane.normal;
  return fit_round_body(surfaces.cloud, surfaces.normals, most, up);
}

std::optional<RoundBody> body_of(const AnalyticSolid& solid, float normals_off_rad = 0) {
  return body_of(render(on_table({solid})).cloud, normals_off_rad);
}

/// Farthest that the body's wall, all around, is from the surface of the solid.
double farthest(const RoundBody& body, const AnalyticSolid& solid) {
  const Eigen::Vector3f x = body.axis.unitOrthogonal(), y = body.axis.cross(x);
  double result = 0;
  for (const RoundSlice& slice : body.slices)
    for (int k = 0; k < 36; ++k) {
      const float angle = 0.1745f * static_cast<float>(k);
      const Eigen::Vector3f p = body.center + slice.along_m * body.axis +
                                slice.radius_m * (std::cos(angle) * x + std::sin(angle) * y);
      result = std::max(result, std::abs(signed_distance(solid, p.cast<double>())));
    }
  return result;
}

TEST(RoundBody, OfNothing) {
  EXPECT_FALSE(fit_round_body({}, {}, {}, std::nullopt));
}

TEST(RoundBody, StandingAndLying) {
  std::vector<AnalyticSolid> solids;
  for (const double radius : {0.018, 0.025, 0.035}) {
    solids.push_back(standing_cylinder(0.02, 0.01, radius, 0.10));
    for (const double yaw : {0.0, 0.5, 1.1, 1.57}) solids.push_back(lying_cylinder(0, 0, radius, 0.13, yaw));
  }
  for (const AnalyticSolid& solid : solids) {
    SCOPED_TRACE("solid " + std::to_string(&solid - solids.data()));
    const auto body = body_of(solid);
    ASSERT_TRUE(body);
    EXPECT_GE(body->slices.size(), 6u);
    EXPECT_LT(farthest(*body, solid), 0.002);
  }
}

TEST(RoundBody, LeansAsFarAsItDoes) {
  AnalyticSolid solid = standing_cylinder(0, 0, 0.025, 0.12);
  solid.T_scene_solid.rotate(Eigen::AngleAxisd(0.5, Eigen::Vector3d(0.6, 0.8, 0)));
  const auto body = body_of(solid);
  ASSERT_TRUE(body);
  EXPECT_LT(farthest(*body, solid), 0.002);
}

TEST(RoundBody, NoiseOfASensorLeavesItWhereItIs) {
  const AnalyticSolid solid = standing_cylinder(0, 0, 0.03, 0.12);
  for (const std::uint32_t seed : {1u, 2u, 3u, 4u}) {
    SCOPED_TRACE(seed);
    const auto body = body_of(with_range_noise(render(on_table({solid})).cloud, 0.0015f, seed));
    ASSERT_TRUE(body);
    EXPECT_LT(farthest(*body, solid), 0.004);
  }
}

TEST(RoundBody, NormalsThatAreOffDoNotHideIt) {
  constexpr float kOff = 0.15f;  // 9 degrees: what a stereo camera leaves at 0.9 m
  for (const double radius : {0.025, 0.038}) {
    const AnalyticSolid solid = standing_cylinder(0, 0, radius, 0.12);
    const auto body = body_of(solid, kOff);
    ASSERT_TRUE(body) << radius;
    EXPECT_LT(farthest(*body, solid), 0.003) << radius;
  }
}

TEST(RoundBody, ABoxIsNone) {
  for (const double yaw : {0.0, 0.4, 0.785, 1.2})
    for (const Eigen::Vector3d& edges : {Eigen::Vector3d(0.05, 0.12, 0.08), Eigen::Vector3d(0.05, 0.05, 0.10),
                                         Eigen::Vector3d(0.02, 0.10, 0.12)})
      for (const float off_rad : {0.0f, 0.15f})
        EXPECT_FALSE(body_of(standing_box(0, 0, edges, yaw), off_rad))
            << edges.transpose() << " turned by " << yaw << ", normals off by " << off_rad;
}

}  // namespace
}  // namespace graspd

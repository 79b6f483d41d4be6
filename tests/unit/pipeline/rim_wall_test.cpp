// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/rim_wall.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>
#include <vector>

namespace graspd {
namespace {

constexpr float kDegrees = 57.2958f;
constexpr float kHeight = 0.1f;  // of the rims

/// A wall without thickness, of which one side is seen, as points and normals with noise.
struct Wall {
  PointCloud cloud;
  Normals normals;
  Segments segments;
  Objects objects;
  std::optional<Support> support;
  ObjectPoints points;
  std::vector<std::uint32_t> all;

  [[nodiscard]] SearchInput input() const { return {cloud, normals, segments, objects, points, support}; }

  [[nodiscard]] std::vector<std::uint32_t> near(const Eigen::Vector3f& p) const {
    std::vector<std::uint32_t> result;
    std::copy_if(all.begin(), all.end(), std::back_inserter(result),
                 [&](std::uint32_t i) { return (cloud.point(i) - p).norm() < RimWall::kReach; });
    return result;
  }
};

/// A place at an angle about the z axis [rad] and a depth below the rim [m], and the normal there.
using Shape = std::function<std::pair<Eigen::Vector3f, Eigen::Vector3f>(float angle, float below)>;

/// From an angle to another, down to 6 cm below the rim; points are off it by noise_m, normals by 6 degrees a
/// millimetre of that.
Wall wall_of(const Shape& shape, float from_rad, float to_rad, float noise_m, std::uint32_t seed) {
  constexpr int kAround = 80, kDown = 20;
  std::mt19937 random(seed);
  std::normal_distribution<float> noise(0, 1);
  Wall wall;
  for (int i = 0; i < kAround; ++i)
    for (int k = 0; k < kDown; ++k) {
      const float part = static_cast<float>(i) / kAround;
      const auto [p, n] = shape(from_rad + (to_rad - from_rad) * part, 0.003f * static_cast<float>(k));
      const Eigen::Vector3f off(noise(random), noise(random), noise(random));
      const Eigen::Vector3f normal = (n + 100 * noise_m * off).normalized();
      wall.cloud.push_back(p + noise_m * noise(random) * n);
      wall.normals.x.push_back(normal.x());
      wall.normals.y.push_back(normal.y());
      wall.normals.z.push_back(normal.z());
    }
  wall.all.resize(wall.cloud.size());
  std::iota(wall.all.begin(), wall.all.end(), 0u);
  return wall;
}

Shape mug(float radius, float side) {
  return [=](float angle, float below) {
    const Eigen::Vector3f out(std::cos(angle), std::sin(angle), 0);
    return std::pair<Eigen::Vector3f, Eigen::Vector3f>(
        radius * out + (kHeight - below) * Eigen::Vector3f::UnitZ(), side * out);
  };
}

/// Half a sphere, its rim level with its center.
Shape bowl(float radius, float side) {
  return [=](float angle, float below) {
    const float r = std::sqrt(radius * radius - below * below);
    const Eigen::Vector3f from_center(r * std::cos(angle), r * std::sin(angle), -below);
    return std::pair<Eigen::Vector3f, Eigen::Vector3f>(from_center + kHeight * Eigen::Vector3f::UnitZ(),
                                                       side / radius * from_center);
  };
}

Shape plate() {
  return [](float angle, float below) {
    return std::pair<Eigen::Vector3f, Eigen::Vector3f>({0.05f * angle, 0, kHeight - below}, {0, 1, 0});
  };
}

/// Mean angle between the wall's normals and the fitted ones at 7.5 mm below its rim, over places on it
/// [degrees].
float mean_error(const Shape& shape, float noise_m, bool with_axis, float from_rad = -1.5f,
                 float to_rad = 1.5f) {
  constexpr float kBelow = 0.0075f;
  float sum = 0;
  int num = 0;
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    const Wall wall = wall_of(shape, from_rad, to_rad, noise_m, seed);
    const auto axis = with_axis ? vessel_axis(wall.input(), wall.all, Eigen::Vector3f::UnitZ())
                                : std::optional<VesselAxis>();
    EXPECT_EQ(axis.has_value(), with_axis);
    for (const float part : {0.3f, 0.5f, 0.7f}) {
      const float angle = from_rad + (to_rad - from_rad) * part;
      const auto [p, n] = shape(angle, 0);
      const Eigen::Vector3f askew = (n + Eigen::Vector3f(-0.1f, 0.12f, 0.1f)).normalized();
      const Eigen::Vector3f up = (Eigen::Vector3f::UnitZ() - askew.z() * askew).normalized();
      const auto fitted = RimWall::fit(wall.input(), wall.near(p), {p, askew, up}, axis);
      EXPECT_TRUE(fitted);
      if (!fitted) return 180;
      const Eigen::Matrix3f axes = fitted->gripper_axes(kBelow);
      EXPECT_NEAR((axes.transpose() * axes - Eigen::Matrix3f::Identity()).norm(), 0, 1e-5f);
      EXPECT_NEAR(axes.determinant(), 1, 1e-5f);
      sum += kDegrees * std::acos(std::min(1.0f, axes.col(1).dot(shape(angle, kBelow).second)));
      ++num;
    }
  }
  return sum / static_cast<float>(num);
}

TEST(RimWall, IsTheWallItself) {
  for (const float side : {-1.0f, 1.0f}) {
    EXPECT_LT(mean_error(mug(0.04f, side), 0, true), 0.2f);
    EXPECT_LT(mean_error(bowl(0.07f, side), 0, true), 2.5f) << "its profile is no parabola";
    EXPECT_LT(mean_error(mug(0.04f, side), 0, false), 2);
    EXPECT_LT(mean_error(bowl(0.07f, side), 0, false), 3);
  }
  EXPECT_LT(mean_error(plate(), 0, false), 0.2f);
}

TEST(RimWall, NoiseOfASensorTurnsItByFewDegrees) {
  constexpr float kNoise = 0.0015f;
  for (const float side : {-1.0f, 1.0f}) {
    EXPECT_LT(mean_error(mug(0.04f, side), kNoise, true), 1.5f);
    EXPECT_LT(mean_error(bowl(0.07f, side), kNoise, true), 2.5f);
    EXPECT_LT(mean_error(mug(0.04f, side), kNoise, false), 3.5f);
    EXPECT_LT(mean_error(bowl(0.07f, side), kNoise, false), 3.5f);
  }
  EXPECT_LT(mean_error(plate(), kNoise, false), 1.5f);
}

TEST(RimWall, NoiseDoesNotBendAStraightWall) {
  constexpr float kNoise = 0.003f;
  const Rim rim{{0.04f, 0, kHeight}, Eigen::Vector3f::UnitX(), Eigen::Vector3f::UnitZ()};
  const VesselAxis axis{Eigen::Vector3f::Zero(), Eigen::Vector3f::UnitZ()};
  int num_straight = 0;
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const Wall wall = wall_of(mug(0.04f, 1), -1.5f, 1.5f, kNoise, seed);
    const auto fitted = RimWall::fit(wall.input(), wall.near(rim.p), rim, axis);
    ASSERT_TRUE(fitted);
    const auto normal = [&](float below_m) -> Eigen::Vector3f {
      return fitted->gripper_axes(below_m).col(1);
    };
    num_straight += normal(0).isApprox(normal(0.04f), 1e-6f) ? 1 : 0;
    EXPECT_GT(normal(0.015f).x(), 0.99f) << "within 8 degrees, seed " << seed;
  }
  EXPECT_GE(num_straight, 18) << "of 20";
}

TEST(RimWall, KnowsHowBentItIs) {
  constexpr float kDepth = 0.03f, kRadius = 0.07f;
  const auto bend = [](const Shape& shape, float radius, bool with_axis) {
    const Wall wall = wall_of(shape, -1.5f, 1.5f, 0.001f, 1);
    const Rim rim{{radius, 0, kHeight}, Eigen::Vector3f::UnitX(), Eigen::Vector3f::UnitZ()};
    const auto axis = with_axis ? std::optional(VesselAxis{Eigen::Vector3f::Zero(), Eigen::Vector3f::UnitZ()})
                                : std::optional<VesselAxis>();
    return RimWall::fit(wall.input(), wall.near(rim.p), rim, axis)->bend_m(kDepth);
  };
  const float rise = 0.125f * kDepth * kDepth / kRadius;
  for (const bool with_axis : {false, true}) {
    EXPECT_NEAR(bend(bowl(kRadius, 1), kRadius, with_axis), rise, 0.5f * rise)
        << "no circle, but its parabola";
    EXPECT_LT(bend(mug(0.04f, 1), 0.04f, with_axis), 0.0005f);
  }
}

TEST(RimWall, KnowsHowSureItIs) {
  const auto error = [](float noise_m, std::size_t every, bool with_axis) {
    const Wall wall = wall_of(mug(0.04f, 1), -1.5f, 1.5f, noise_m, 1);
    const Eigen::Vector3f p(0.04f, 0, kHeight);
    std::vector<std::uint32_t> some;
    for (const std::uint32_t i : wall.near(p))
      if (i % every == 0) some.push_back(i);
    const auto axis = with_axis ? std::optional(VesselAxis{Eigen::Vector3f::Zero(), Eigen::Vector3f::UnitZ()})
                                : std::optional<VesselAxis>();
    const Rim rim{p, Eigen::Vector3f::UnitX(), Eigen::Vector3f::UnitZ()};
    return RimWall::fit(wall.input(), some, rim, axis)->error_rad();
  };
  for (const bool with_axis : {false, true}) {
    EXPECT_LT(error(0.0005f, 1, with_axis), 0.5f * error(0.0015f, 1, with_axis)) << "less noise";
    EXPECT_LT(error(0.001f, 1, with_axis), 0.7f * error(0.001f, 7, with_axis)) << "more points";
    EXPECT_GT(error(0.001f, 1, with_axis), 0.001f);
    EXPECT_LT(error(0.001f, 1, with_axis), 0.03f);
  }
  EXPECT_LT(error(0.001f, 1, true), error(0.001f, 1, false)) << "an axis leaves less to be found out";
}

TEST(RimWall, TheHandComesDownAlongTheWall) {
  const Wall wall = wall_of(mug(0.04f, 1), -1, 1, 0, 1);
  const Eigen::Vector3f p(0.04f, 0, kHeight);
  const auto fitted = RimWall::fit(wall.input(), wall.near(p),
                                   {p, Eigen::Vector3f::UnitX(), Eigen::Vector3f::UnitZ()}, std::nullopt);
  ASSERT_TRUE(fitted);
  const Eigen::Matrix3f axes = fitted->gripper_axes(0.01f);
  EXPECT_GT(axes(2, 2) * -1, 0.999f);
  EXPECT_GT(std::abs(axes(1, 0)), 0.999f) << "major axis along the rim";
}

TEST(RimWall, TooFewPointsTellNothing) {
  const Wall wall = wall_of(mug(0.04f, 1), -1, 1, 0, 1);
  const Eigen::Vector3f p(0.04f, 0, kHeight);
  const std::vector<std::uint32_t> few{0, 1, 2};
  EXPECT_FALSE(
      RimWall::fit(wall.input(), few, {p, Eigen::Vector3f::UnitX(), Eigen::Vector3f::UnitZ()}, std::nullopt));
}

TEST(VesselAxis, IsWhereTheWallsAreRoundAbout) {
  const Wall wall = wall_of(mug(0.04f, -1), -1.5f, 1.5f, 0.001f, 1);
  const auto axis = vessel_axis(wall.input(), wall.all, Eigen::Vector3f::UnitZ());
  ASSERT_TRUE(axis);
  EXPECT_LT(axis->center.head<2>().norm(), 0.002f);
}

TEST(VesselAxis, PlatesBoxesAndNothingHaveNone) {
  const Eigen::Vector3f up = Eigen::Vector3f::UnitZ();
  const Wall flat = wall_of(plate(), -1, 1, 0.001f, 1);
  EXPECT_FALSE(vessel_axis(flat.input(), flat.all, up));
  const Shape box = [](float angle, float below) {
    const float z = kHeight - below;
    return angle < 0 ? std::pair<Eigen::Vector3f, Eigen::Vector3f>({0.06f * angle, 0, z}, {0, 1, 0})
                     : std::pair<Eigen::Vector3f, Eigen::Vector3f>({0, -0.06f * angle, z}, {1, 0, 0});
  };
  const Wall corner = wall_of(box, -1, 1, 0.001f, 1);
  EXPECT_FALSE(vessel_axis(corner.input(), corner.all, up));
  EXPECT_FALSE(vessel_axis(flat.input(), {}, up));
}

}  // namespace
}  // namespace graspd

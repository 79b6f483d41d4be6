// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/object_shape.hpp"

#include <gtest/gtest.h>

#include <memory_resource>

#include <numeric>

#include "tests/support/clouds.hpp"

namespace graspd {
namespace {

/// A cloud whose points are all one segment of one object, seen from 1 m above.
class OneObject {
 public:
  explicit OneObject(PointCloud cloud) : points_(cloud.size()) {
    std::iota(points_.begin(), points_.end(), 0u);
    surfaces_.segments.of_point.assign(cloud.size(), 7);
    surfaces_.cloud = std::move(cloud);
    surfaces_.cloud.viewpoint = {0, 0, 1};
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (const std::uint32_t i : points_) sum += surfaces_.cloud.point(i);
    center_ = sum / static_cast<float>(points_.size());
  }
  [[nodiscard]] ObjectShape shape() const { return {surfaces_, points_, 3, center_}; }
  Surfaces& surfaces() { return surfaces_; }

 private:
  Surfaces surfaces_;
  std::pmr::vector<std::uint32_t> points_;
  Eigen::Vector3f center_;
};

/// Jaws from above that close along y.
Eigen::Matrix3f from_above() {
  Eigen::Matrix3f rotation;
  rotation << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  return rotation;
}

PointCloud top(float length_m, float width_m) {
  constexpr float kStep = 0.003f;
  const auto steps = [](float edge_m) { return static_cast<int>(edge_m / kStep) + 1; };
  return grid_patch({-0.5f * length_m, -0.5f * width_m, 0}, {kStep, 0, 0}, {0, kStep, 0}, steps(length_m),
                    steps(width_m));
}

TEST(ObjectShape, MiddleIsHalfWayHoweverDenseTheEndsAre) {
  PointCloud cloud = top(0.2f, 0.05f);
  for (int i = 0; i < 2000; ++i) cloud.push_back({0.09f, 0, 0});
  const OneObject object(cloud);
  const ObjectShape shape = object.shape();
  EXPECT_GT(shape.center().x(), 0.03f) << "which a mean is not";
  EXPECT_NEAR(shape.middle(Eigen::Vector3f::UnitX()), 0, 0.006f);
  EXPECT_NEAR(shape.middle(-Eigen::Vector3f::UnitX()), 0, 0.006f);
}

TEST(ObjectShape, StrayPointsDoNotMoveTheMiddle) {
  PointCloud cloud = top(0.2f, 0.05f);
  const std::size_t strays = cloud.size() / 50;
  for (std::size_t i = 0; i < strays; ++i) cloud.push_back({0.5f, 0, 0});
  EXPECT_NEAR(OneObject(cloud).shape().middle(Eigen::Vector3f::UnitX()), 0, 0.004f);
}

TEST(ObjectShape, OnePointIsItsOwnMiddle) {
  PointCloud cloud;
  cloud.push_back({0.1f, 0.2f, 0.3f});
  const OneObject object(cloud);
  EXPECT_EQ(object.shape().middle(Eigen::Vector3f::UnitY()), 0.2f);
  const auto place = object.shape().middle_place(from_above(), {});
  ASSERT_TRUE(place);
  EXPECT_LT((place->position - Eigen::Vector3f(0.1f, 0.2f, 0.3f)).norm(), 1e-6f);
}

TEST(ObjectShape, SightGoesFromTheSensorToTheObject) {
  EXPECT_LT((OneObject(top(0.1f, 0.1f)).shape().sight() + Eigen::Vector3f::UnitZ()).norm(), 0.02f);
}

TEST(ObjectShape, MiddlePlaceIsOnTop) {
  PointCloud cloud = joined(top(0.2f, 0.05f), box_shell({-0.1f, -0.025f, -0.06f}, {0.1f, 0.025f, 0}, 0.003f));
  OneObject object(cloud);
  const auto place = object.shape().middle_place(from_above(), {});
  ASSERT_TRUE(place);
  EXPECT_LT(place->position.norm(), 0.004f);
  EXPECT_EQ(place->rotation, from_above());
  EXPECT_EQ(place->segment, 7);
  EXPECT_EQ(place->object, 3);
}

TEST(ObjectShape, NoPlaceWhereTheJawsDoNotGetAround) {
  const Gripper gripper;
  EXPECT_TRUE(OneObject(top(0.2f, gripper.aperture_m - 0.005f)).shape().middle_place(from_above(), gripper));
  EXPECT_FALSE(OneObject(top(0.2f, gripper.aperture_m + 0.02f)).shape().middle_place(from_above(), gripper));
}

TEST(ObjectShape, NoPlaceOnPointsOfNoSegment) {
  OneObject object(top(0.2f, 0.05f));
  std::fill(object.surfaces().segments.of_point.begin(), object.surfaces().segments.of_point.end(), -1);
  EXPECT_FALSE(object.shape().middle_place(from_above(), {}));
}

TEST(ObjectShape, LongAxisOnlyOfLongObjects) {
  const auto axis = OneObject(top(0.2f, 0.05f)).shape().long_axis();
  ASSERT_TRUE(axis);
  EXPECT_NEAR(std::abs(axis->x()), 1, 1e-4f);
  EXPECT_FALSE(OneObject(top(0.1f, 0.095f)).shape().long_axis());
}

}  // namespace
}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/label_scene.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/support/clouds.hpp"
#include "tests/unit/evaluate/labelled_scene.hpp"

namespace graspd {
namespace {

std::vector<Eigen::Vector3f> points_of(const PointCloud& cloud) {
  std::vector<Eigen::Vector3f> points;
  for (std::size_t i = 0; i < cloud.size(); ++i) points.push_back(cloud.point(i));
  return points;
}

TEST(LabelScene, LabelsAreThoseOfTheMosdDataSet) {
  EXPECT_EQ(object_of_label(0), kNoObject);
  EXPECT_EQ(object_of_label(1), kOnSupport);
  EXPECT_EQ(object_of_label(9), kOnSupport);
  EXPECT_EQ(object_of_label(20), 2);
  EXPECT_EQ(object_of_label(29), 2);
  EXPECT_EQ(object_of_label(130), 13);
}

TEST(LabelScene, FindsObjectsAndSupport) {
  const LabelScene scene(labelled(three_objects()));
  ASSERT_EQ(scene.objects().size(), 3u);
  EXPECT_EQ(scene.objects()[0].id, 2);
  EXPECT_EQ(scene.objects()[2].id, 4);
  ASSERT_TRUE(scene.support());
  EXPECT_GT(scene.support()->normal.z(), 0.9999f);
  EXPECT_NEAR(scene.support()->offset_m, 0, 1e-3f);
}

TEST(LabelScene, APlaneIsFoundAmongOtherPoints) {
  const PointCloud plane = grid_patch({0, 0, 0.5f}, {0.01f, 0, 0}, {0, 0.01f, 0.005f}, 40, 40);
  const PointCloud others = random_cloud(400, {0, 0, 0.6f}, {0.4f, 0.4f, 1.0f}, 3);
  const auto found = fit_plane(points_of(joined(plane, others)), {0, 0, 2});
  ASSERT_TRUE(found);
  for (std::size_t i = 0; i < plane.size(); ++i) EXPECT_LT(std::abs(found->height(plane.point(i))), 0.004f);
  EXPECT_GT(found->height({0, 0, 2}), 0);
  EXPECT_LT(fit_plane(points_of(plane), {0, 0, -2})->normal.z(), 0);
}

TEST(LabelScene, FewPointsAreNoPlane) {
  EXPECT_FALSE(fit_plane({}, {0, 0, 0}));
  EXPECT_FALSE(fit_plane(std::vector<Eigen::Vector3f>(99, {1, 2, 3}), {0, 0, 0}));
  EXPECT_FALSE(fit_plane(std::vector<Eigen::Vector3f>(200, {1, 2, 3}), {0, 0, 0}));  // all the same
}

TEST(LabelScene, NothingIsAScene) {
  const LabelScene scene{LabelledCloud()};
  EXPECT_TRUE(scene.objects().empty());
  EXPECT_FALSE(scene.support());
}

TEST(LabelScene, CloudsWithoutLabelsAreRefused) {
  LabelledCloud cloud = labelled(box_on_table());
  cloud.label.clear();
  EXPECT_THROW(LabelScene{cloud}, std::runtime_error);
}

}  // namespace
}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/runs.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/support/clouds.hpp"
#include "tests/unit/evaluate/labelled_scene.hpp"

namespace graspd {
namespace {

PointCloud organized(int width, int height) {
  PointCloud cloud;
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) cloud.push_back({static_cast<float>(u), static_cast<float>(v), 1});
  cloud.width = width;
  cloud.height = height;
  return cloud;
}

TEST(Runs, HalfKeepsEverySecondRowAndColumn) {
  for (const auto& [width, height] : {std::pair{6, 4}, {5, 3}, {1, 2}}) {
    const PointCloud half = changed(organized(width, height), {true, false});
    EXPECT_EQ(half.width, (width + 1) / 2);
    EXPECT_EQ(half.height, (height + 1) / 2);
    ASSERT_EQ(half.size(), static_cast<std::size_t>(half.width * half.height));
    for (std::size_t i = 0; i < half.size(); ++i) {
      EXPECT_EQ(half.x[i], static_cast<float>(2 * (static_cast<int>(i) % half.width)));
      EXPECT_EQ(half.y[i], static_cast<float>(2 * (static_cast<int>(i) / half.width)));
    }
  }
}

TEST(Runs, UnorganizedKeepsThePointsAndNotTheirOrder) {
  const PointCloud before = labelled(box_on_table()).cloud;
  const PointCloud after = changed(before, {false, true});
  EXPECT_EQ(after.size(), finite_points(before).size());
  EXPECT_EQ(after.height, 1);
  EXPECT_EQ(after.viewpoint, before.viewpoint);
  EXPECT_NE(after.x, finite_points(before).x);
}

TEST(Runs, NoChangeIsNone) {
  EXPECT_EQ(changed(organized(4, 3), {}).height, 3);
  EXPECT_TRUE(changed({}, {true, true}).empty());
}

TEST(Runs, EveryVariantIsAValidConfigurationWithItsOwnName) {
  const DetectionRun base{"graspd", {}, {}, {}};
  std::set<std::string> names{base.name};
  for (const std::string_view group : kVariantGroups) {
    const auto runs = variants(base, group);
    EXPECT_GE(runs.size(), 2u) << group;
    for (const DetectionRun& run : runs) {
      EXPECT_TRUE(names.insert(run.name).second) << run.name;
      EXPECT_FALSE(run.detect.validate()) << run.name;
      EXPECT_FALSE(run.detect.smoothness.validate()) << run.name;
      EXPECT_FALSE(run.gripper.validate()) << run.name;
    }
  }
  EXPECT_TRUE(variants(base, "no such group").empty());
}

TEST(Runs, SingleThresholdsAreSingle) {
  for (const DetectionRun& run : variants({"graspd", {}, {}, {}}, "thresholds"))
    EXPECT_EQ(run.detect.smoothness.theta_low_deg, run.detect.smoothness.theta_high_deg);
}

TEST(Runs, NeighborhoodsReachTheNextVoxels) {
  for (const float leaf : {0.001f, 0.003f, 0.0045f, 0.02f}) {
    DetectConfig config;
    set_voxel(config, leaf);
    EXPECT_EQ(config.downsample.leaf_size_m, leaf);
    EXPECT_GE(config.neighborhoods.radius_m, 1.5f * leaf);
    EXPECT_FALSE(config.validate()) << leaf;
  }
}

}  // namespace
}  // namespace graspd

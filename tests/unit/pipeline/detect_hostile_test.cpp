// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// detect_handles on clouds that no scene looks like: it answers, and says how far it got.
#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <string>
#include <vector>

#include "service/pipeline/detect_handles.hpp"
#include "tests/support/clouds.hpp"
#include "tests/support/scene_gallery.hpp"
#include "tests/unit/pipeline/detections.hpp"

namespace graspd {
namespace {

Detection detect(const PointCloud& cloud) {
  return detect_handles(cloud, {}, {});
}

PointCloud all_equal(std::size_t n, const Eigen::Vector3f& p) {
  return random_cloud(n, p, p, 1);
}

TEST(DetectHostile, EmptyCloud) {
  const Detection detection = detect({});
  EXPECT_EQ(detection.status, DetectionStatus::kEmptyCloud);
  EXPECT_EQ(detection.points_in, 0);
  EXPECT_TRUE(detection.handles.empty());
}

TEST(DetectHostile, NoFinitePoint) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    const Detection detection = detect(all_equal(1000, Eigen::Vector3f::Constant(bad)));
    EXPECT_EQ(detection.status, DetectionStatus::kNoFinitePoints);
    EXPECT_EQ(detection.points_in, 1000);
    EXPECT_EQ(detection.points_used, 0);
  }
}

TEST(DetectHostile, NothingInTheWorkspace) {
  const PointCloud cloud = render(three_objects()).cloud;
  DetectConfig config;
  config.workspace.min_m = {5, 5, 5};
  EXPECT_EQ(detect_handles(cloud, {}, config).status, DetectionStatus::kNothingInWorkspace);
  config = {};
  config.workspace.max_range_m = 0.1f;
  EXPECT_EQ(detect_handles(cloud, {}, config).status, DetectionStatus::kNothingInWorkspace);
  EXPECT_EQ(detect(all_equal(10, {1e30f, -1e30f, 1e30f})).status, DetectionStatus::kNothingInWorkspace);
}

TEST(DetectHostile, OneTwoAndThreePoints) {
  for (std::size_t n = 1; n <= 3; ++n) {
    const Detection detection = detect(random_cloud(n, {0, 0, 0.5f}, {0.01f, 0.01f, 0.51f}, 1));
    EXPECT_EQ(detection.status, DetectionStatus::kNoHandles);
    EXPECT_EQ(detection.points_in, static_cast<int>(n));
  }
}

TEST(DetectHostile, AMillionPointsAtOnePlace) {
  const Detection detection = detect(all_equal(1000000, {0.1f, 0.2f, 0.7f}));
  EXPECT_EQ(detection.status, DetectionStatus::kNoHandles);
  EXPECT_EQ(detection.points_used, 1);
}

TEST(DetectHostile, AMillionPointsInOneCell) {
  const PointCloud cloud = random_cloud(1000000, {0.1f, 0.2f, 0.7f}, {0.108f, 0.208f, 0.708f}, 1);
  const Detection detection = detect(cloud);
  EXPECT_EQ(detection.status, DetectionStatus::kNoHandles);
  EXPECT_LE(detection.points_used, 64);
}

/// Found by the fuzzer: a picture of them has no height.
TEST(DetectHostile, PointsOnNearlyOneRay) {
  for (const float slope : {0.f, 1e-38f, 1e-30f, 1e-20f, 1e-12f, 1e-6f}) {
    PointCloud cloud;
    for (int i = 1; i <= 200; ++i) {
      const float z = 0.5f + 0.001f * static_cast<float>(i);
      cloud.push_back({slope * static_cast<float>(i % 7) * z, slope * static_cast<float>(i % 5) * z, z});
    }
    EXPECT_EQ(detect(cloud).points_in, 200) << slope;
  }
}

TEST(DetectHostile, HugeAndTinyCoordinatesBetweenTheOthers) {
  const PointCloud scene = finite_points(render(three_objects()).cloud);
  PointCloud cloud = scene;
  const float denormal = std::numeric_limits<float>::denorm_min();
  for (const float value :
       {1e30f, -1e30f, std::numeric_limits<float>::max(), std::numeric_limits<float>::lowest()})
    for (int axis = 0; axis < 3; ++axis) {
      Eigen::Vector3f p(0.1f, 0.1f, 0.1f);
      p[axis] = value;
      cloud.push_back(p);
    }
  const Detection detection = detect(cloud);
  EXPECT_EQ(detection.status, DetectionStatus::kOk);
  EXPECT_EQ(detection.handles.size(), detect(scene).handles.size());
  // Denormals are points at the origin like any other.
  PointCloud tiny = all_equal(5000, {denormal, -denormal, 2 * denormal});
  tiny.viewpoint = {0, 0, 1};
  EXPECT_EQ(detect(tiny).points_used, 1);
}

TEST(DetectHostile, PointsOnLines) {
  PointCloud cloud = joined(grid_patch({-0.2f, 0, 0.6f}, {0.0004f, 0, 0}, {0, 0, 0}, 1000, 1),
                            grid_patch({0, -0.2f, 0.7f}, {0, 0.0004f, 0}, {0, 0, 0}, 1000, 1));
  cloud = joined(cloud, grid_patch({0, 0, 0.4f}, {0.0001f, 0.0002f, 0.0003f}, {0, 0, 0}, 1000, 1));
  EXPECT_EQ(detect(cloud).status, DetectionStatus::kNoHandles);
}

TEST(DetectHostile, PointsScatteredThroughTheWholeWorkspace) {
  const Detection detection = detect(random_cloud(50000, {-4, -4, -4}, {4, 4, 4}, 1));
  EXPECT_EQ(detection.status, DetectionStatus::kNoHandles);
  EXPECT_GT(detection.points_used, 10000);
}

TEST(DetectHostile, ADenseBlockOfPoints) {
  const Detection detection = detect(random_cloud(100000, {-0.05f, -0.05f, 0.5f}, {0.05f, 0.05f, 0.6f}, 1));
  EXPECT_EQ(detection.points_in, 100000);
}

TEST(DetectHostile, ViewpointsOutOfPlace) {
  const PointCloud scene = render(three_objects()).cloud;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const Eigen::Vector3f& eye :
       {Eigen::Vector3f(nan, 0, 0), Eigen::Vector3f(1e30f, 0, 0), Eigen::Vector3f(0, 0, -0.5f),
        scene.point(scene.size() / 2), Eigen::Vector3f(0, 0, 0.02f)}) {
    PointCloud cloud = scene;
    cloud.viewpoint = eye;
    const Detection detection = detect(cloud);
    for (const Handle& handle : detection.handles) {
      EXPECT_TRUE(handle.position.allFinite());
      EXPECT_TRUE(handle.rotation.allFinite());
    }
  }
}

TEST(DetectHostile, ALimitOnTheNumberOfHandles) {
  DetectConfig config;
  config.ranking.max_handles = 2;
  EXPECT_EQ(detect_handles(render(three_objects()).cloud, {}, config).handles.size(), 2u);
}

TEST(DetectHostile, ExtremeButValidSettings) {
  const PointCloud cloud = render(three_objects()).cloud;
  DetectConfig coarse;
  coarse.downsample.leaf_size_m = 0.1f;
  coarse.neighborhoods.radius_m = 0.3f;
  ASSERT_FALSE(coarse.validate());
  EXPECT_LT(detect_handles(cloud, {}, coarse).points_used, 200);
  DetectConfig smooth;
  smooth.smoothing.iterations = 20;
  EXPECT_GT(detect_handles(cloud, {}, smooth).points_used, 1000);
  DetectConfig nothing;
  nothing.search.bands = nothing.search.seeds = false;
  EXPECT_EQ(detect_handles(cloud, {}, nothing).num_candidates, 0);
}

TEST(DetectStages, AreReportedOnceEach) {
  std::vector<std::string> stages;
  const auto note = [&](std::string_view stage) { stages.emplace_back(stage); };
  const PointCloud cloud = render(box_on_table()).cloud;
  const Detection observed = detect_handles(cloud, {}, {}, note);
  ASSERT_FALSE(stages.empty());
  EXPECT_EQ(stages.front(), "workspace_filter");
  EXPECT_EQ(stages.back(), "handles");
  const std::set<std::string> expected{"workspace_filter", "downsample", "support",     "neighborhoods",
                                       "normals",          "smoothing",  "edge_points", "region_growing",
                                       "segments",         "objects",    "index",       "handles"};
  EXPECT_EQ(std::set<std::string>(stages.begin(), stages.end()), expected);
  EXPECT_EQ(stages.size(), expected.size());
  EXPECT_TRUE(same_bits(observed, detect(cloud))) << "watching changes nothing";
}

}  // namespace
}  // namespace graspd

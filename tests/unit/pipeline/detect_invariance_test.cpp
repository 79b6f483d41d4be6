// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What must not matter to detect_handles: the order of the points, the frame, duplicates, missing points, the
// layout, the number of threads, and what was detected before.
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <map>
#include <string>
#include <utility>

#include "service/pipeline/detect_handles.hpp"
#include "tests/support/clouds.hpp"
#include "tests/support/handle_truth.hpp"
#include "tests/support/scene_gallery.hpp"
#include "tests/unit/pipeline/detections.hpp"

namespace graspd {
namespace {

Detection detect(const PointCloud& cloud) {
  return detect_handles(cloud, {}, {});
}

/// Rounding of the voxels' means can tip a candidate at the limit of a check, and with it which handle of a
/// place stays.
void expect_same_grips(const Detection& a, const Detection& b, double least_share = 0.8) {
  const GripDifference tolerance{0.002f, 2.0f, 0.002f};
  ASSERT_FALSE(a.handles.empty());
  ASSERT_FALSE(b.handles.empty());
  EXPECT_GE(share_found(a.handles, b.handles, tolerance), least_share);
  EXPECT_GE(share_found(b.handles, a.handles, tolerance), least_share);
  const GripDifference best = difference(a.handles[0], b.handles[0]);
  EXPECT_LE(best.distance_m, tolerance.distance_m);
  EXPECT_LE(best.angle_deg, tolerance.angle_deg);
  EXPECT_LE(best.width_m, tolerance.width_m);
}

AnalyticScene in_optical_frame(const AnalyticScene& scene) {
  return moved(scene, scene.camera.T_scene_camera.inverse());
}

TEST(DetectInvariance, OrderOfThePoints) {
  for (const AnalyticScene& scene : {three_objects(), bottle_beside_box()}) {
    const PointCloud cloud = render(scene).cloud;
    const Detection detection = detect(cloud);
    for (std::uint32_t seed = 0; seed < 3; ++seed)
      expect_same_grips(detection, detect(shuffled(cloud, seed)));
  }
}

TEST(DetectInvariance, OrganizedOrNot) {
  const PointCloud organized = render(three_objects()).cloud;
  Detection a = detect(organized), b = detect(finite_points(organized));
  // The same points in the same order: only the number of points that came in may differ.
  b.points_in = a.points_in;
  EXPECT_TRUE(same_bits(a, b));
}

/// In the optical frame the image tells what was seen; without it that is rendered, a little differently
/// along borders.
TEST(DetectInvariance, OrganizedInTheOpticalFrameOrNot) {
  // A bottle is held as well from any side: of its handles the first one alone is sure to be the same.
  for (const auto& [scene, least_share] :
       {std::pair(three_objects(), 0.7), std::pair(bottle_beside_box(), 0.3)}) {
    const PointCloud organized = render(in_optical_frame(scene)).cloud;
    expect_same_grips(detect(organized), detect(finite_points(organized)), least_share);
  }
}

TEST(DetectInvariance, MissingPointsBetweenTheOthers) {
  const PointCloud cloud = finite_points(render(three_objects()).cloud);
  Detection a = detect(cloud), b = detect(with_missing_between(cloud, 7));
  EXPECT_GT(b.points_in, a.points_in);
  b.points_in = a.points_in;
  EXPECT_TRUE(same_bits(a, b));
}

/// Solids that have a handle, and the width of the best on each.
std::map<int, float> best_widths(const Detection& detection, const AnalyticScene& scene) {
  std::map<int, float> widths;
  for (const Handle& handle : detection.handles)
    widths.try_emplace(judge(handle, {}, DetectConfig{}.check, scene).solid, handle.width_m);
  return widths;
}

TEST(DetectInvariance, DuplicatePoints) {
  const AnalyticScene scene = three_objects();
  const PointCloud cloud = finite_points(render(scene).cloud);
  const Detection once = detect(cloud), twice = detect(doubled(cloud));
  EXPECT_EQ(once.points_used, twice.points_used);
  EXPECT_EQ(once.segments.size(), twice.segments.size());
  // Twice the points are twice the evidence, so that handles need not be equal; the objects that can be held
  // are.
  const auto a = best_widths(once, scene), b = best_widths(twice, scene);
  ASSERT_EQ(a.size(), 3u);
  ASSERT_EQ(b.size(), 3u);
  for (const auto& [solid, width] : a) EXPECT_NEAR(width, b.at(solid), 0.004) << "solid " << solid;
}

Eigen::Isometry3d pose(double angle, const Eigen::Vector3d& axis, const Eigen::Vector3d& translation) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  T.translation() = translation;
  return T;
}

// Voxels lie on the axes of the frame, so that in another frame each holds other points: means move by up to
// half a voxel, candidates with them, and bands by as much. What is held stays, and how wide it is, as far as
// both of its sides are seen: one out of sight is carried on from what is seen, at another place otherwise.
TEST(DetectInvariance, MotionOfTheFrame) {
  const AnalyticScene scene = three_objects();
  const PointCloud cloud = render(scene).cloud;
  const auto here = best_widths(detect(cloud), scene);
  ASSERT_EQ(here.size(), 3u);
  const std::vector<Eigen::Isometry3d> poses{pose(0, {0, 0, 1}, {0.0013, -0.0007, 0.0021}),
                                             pose(0, {0, 0, 1}, {3, -2, 1}), pose(0.5, {0, 0, 1}, {0, 0, 0}),
                                             pose(2.5, {1, 2, -1}, {1, 1, 1}),
                                             pose(-1.2, {1, 0, 0.3}, {-2, 0, 0.5})};
  for (const Eigen::Isometry3d& T : poses) {
    SCOPED_TRACE(std::to_string(T.translation().x()));
    const Detection there = detect(moved(cloud, T.cast<float>()));
    Detection back = there;
    for (Handle& handle : back.handles) handle = transformed(handle, T.inverse().cast<float>());
    const auto widths = best_widths(back, scene);
    ASSERT_EQ(widths.size(), 3u);
    for (const auto& [solid, width] : here) EXPECT_NEAR(width, widths.at(solid), 0.005) << "solid " << solid;
    for (const Handle& handle : back.handles) {
      const HandleTruth truth = judge(handle, {}, DetectConfig{}.check, scene);
      EXPECT_EQ(truth.num_between, 1);
      EXPECT_NEAR(handle.width_m, truth.width_m, DetectConfig{}.check.clearance_m);
      EXPECT_LT(truth.finger_depth_m, 0.0005);
    }
  }
}

// By whole voxels that are whole spacings of the sparse copy (1.33 voxels) and of the seeds (25 mm) too,
// nearly the same points meet everywhere: a metre is 399, 300 and 40 of them. Coordinates have fewer digits
// there, which tips some candidates.
TEST(DetectInvariance, MotionByWholeVoxelsMovesTheHandles) {
  const PointCloud cloud = render(three_objects()).cloud;
  DetectConfig config;
  config.downsample.leaf_size_m = 1.0f / 399;
  const Detection here = detect_handles(cloud, {}, config);
  ASSERT_FALSE(here.handles.empty());
  const GripDifference tolerance{0.002f, 2.0f, 0.002f};
  double found = 0;
  const std::vector<Eigen::Vector3f> motions{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 0, 1}, {1, -1, 0}};
  for (const Eigen::Vector3f& motion : motions) {
    Eigen::Isometry3f T = Eigen::Isometry3f::Identity();
    T.translation() = motion;
    Detection there = detect_handles(moved(cloud, T), {}, config);
    for (Handle& handle : there.handles) handle = transformed(handle, T.inverse());
    ASSERT_FALSE(there.handles.empty());
    EXPECT_LE(difference(here.handles[0], there.handles[0]).distance_m, tolerance.distance_m);
    found += share_found(here.handles, there.handles, tolerance) / static_cast<double>(motions.size());
  }
  EXPECT_GE(found, 0.7);
}

TEST(DetectInvariance, NumberOfThreads) {
  for (const AnalyticScene& scene :
       {spread_objects(), bottle_beside_box(), in_optical_frame(bottle_beside_box())}) {
    const PointCloud cloud = with_range_noise(render(scene).cloud, 0.0007f, 1);
    std::vector<Detection> detections;
    for (const int threads : {1, 2, 4}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(threads));
      tbb::task_arena arena(threads);
      arena.execute([&] { detections.push_back(detect(cloud)); });
    }
    EXPECT_FALSE(detections[0].handles.empty());
    EXPECT_TRUE(same_bits(detections[0], detections[1]));
    EXPECT_TRUE(same_bits(detections[0], detections[2]));
  }
}

TEST(DetectInvariance, NumberOfThreadsWithBlocksOfPixels) {
  const AnalyticScene scene = in_optical_frame(three_objects());
  const PointCloud cloud = with_range_noise(render(scene).cloud, 0.0007f, 1);
  DetectConfig config;
  config.downsample.image_blocks = true;
  std::vector<Detection> detections;
  for (const int threads : {1, 2, 4, 8}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);
    arena.execute([&] { detections.push_back(detect_handles(cloud, {}, config)); });
  }
  for (const Detection& detection : detections) EXPECT_TRUE(same_bits(detections[0], detection));
  std::map<int, int> handles_on_solid;
  for (const Handle& handle : detections[0].handles) ++handles_on_solid[judge(handle, {}, {}, scene).solid];
  EXPECT_FALSE(same_bits(detections[0], detect(cloud))) << "voxels are others";
  for (const int solid : {1, 2, 3}) EXPECT_GT(handles_on_solid[solid], 0) << solid;
}

TEST(DetectInvariance, CalledTwiceAndAfterAnotherCloud) {
  const PointCloud cloud = render(three_objects()).cloud;
  const Detection first = detect(cloud);
  EXPECT_TRUE(same_bits(first, detect(cloud)));
  EXPECT_FALSE(same_bits(first, detect(render(box_on_table()).cloud)));
  EXPECT_TRUE(same_bits(first, detect(cloud)));
}

TEST(DetectInvariance, SeveralAtOnce) {
  const PointCloud cloud = render(three_objects()).cloud;
  const Detection alone = detect(cloud);
  std::vector<Detection> together(4);
  tbb::task_arena arena(4);
  arena.execute([&] {
    tbb::task_group group;
    for (Detection& detection : together) group.run([&] { detection = detect(cloud); });
    group.wait();
  });
  for (const Detection& detection : together) EXPECT_TRUE(same_bits(alone, detection));
}

}  // namespace
}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/image_blocks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "service/pipeline/workspace_filter.hpp"
#include "tests/support/clouds.hpp"
#include "tests/support/scene_gallery.hpp"

namespace graspd {
namespace {

constexpr float kLeaf = 0.003f;

/// What a camera sees of a depth for each pixel; none where that is NaN.
template <class DepthOf>
WorkspaceResult image_of(int width, int height, const PinholeModel& camera, const DepthOf& depth_of) {
  PointCloud cloud;
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const auto column = static_cast<float>(u), row = static_cast<float>(v);
      const float z = depth_of(u, v);
      cloud.push_back(
          {(column - camera.cx_px) / camera.fx_px * z, (row - camera.cy_px) / camera.fy_px * z, z});
    }
  cloud.width = width;
  cloud.height = height;
  return filter_workspace(cloud, {});
}

Downsampled thin(const WorkspaceResult& kept) {
  const auto camera = fit_pinhole(kept.cloud, kept.pixels);
  EXPECT_TRUE(camera);
  return thin_by_blocks(kept.cloud, kept.pixels, camera.value(), kLeaf);
}

/// Each point is the mean of those that name it, which are near it; none is left out.
void expect_means_of_near_points(const PointCloud& cloud, const Downsampled& result) {
  ASSERT_EQ(result.voxel_of_point.size(), cloud.size());
  EXPECT_EQ(result.cloud.width, static_cast<int>(result.cloud.size()));
  EXPECT_EQ(result.cloud.height, 1);
  std::vector<Eigen::Vector3d> sums(result.cloud.size(), Eigen::Vector3d::Zero());
  std::vector<int> counts(result.cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const std::uint32_t g = result.voxel_of_point[i];
    ASSERT_LT(g, result.cloud.size());
    sums[g] += cloud.point(i).cast<double>();
    ++counts[g];
    ASSERT_LT(std::abs(cloud.z[i] - result.cloud.z[g]), 2 * kLeaf) << "no depths are mixed";
    ASSERT_LT((cloud.point(i) - result.cloud.point(g)).norm(), 3 * kLeaf);
  }
  for (std::size_t g = 0; g < sums.size(); ++g) {
    ASSERT_GT(counts[g], 0);
    ASSERT_LT((result.cloud.point(g).cast<double>() - sums[g] / counts[g]).norm(), 1e-6);
  }
}

TEST(ImageBlocks, AsManyPointsAsVoxelsOnWhatFacesTheCamera) {
  for (const float depth : {0.3f, 0.6f, 0.9f}) {
    const WorkspaceResult kept =
        image_of(320, 240, {525, 525, 159.5f, 119.5f}, [depth](int, int) { return depth; });
    const Downsampled blocks = thin(kept), voxels = downsample(kept.cloud, {kLeaf});
    expect_means_of_near_points(kept.cloud, blocks);
    const double ratio = static_cast<double>(blocks.cloud.size()) / static_cast<double>(voxels.cloud.size());
    EXPECT_GT(ratio, 0.6) << depth;
    EXPECT_LT(ratio, 1.6) << depth;
  }
}

TEST(ImageBlocks, SquareInSpaceWherePixelsAreNot) {
  const WorkspaceResult kept = image_of(400, 100, {800, 200, 199.5f, 49.5f}, [](int, int) { return 0.3f; });
  const Downsampled blocks = thin(kept);
  expect_means_of_near_points(kept.cloud, blocks);
  // Blocks of 8 x 2 pixels, 3 mm wide and high.
  EXPECT_EQ(blocks.cloud.size(), 50u * 50u);
  EXPECT_NEAR(blocks.cloud.x[1] - blocks.cloud.x[0], 0.003f, 1e-5f);
  EXPECT_NEAR(blocks.cloud.y[50] - blocks.cloud.y[0], 0.003f, 1e-5f);
}

TEST(ImageBlocks, DepthsAreNotMixedAcrossEdges) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  // Stripes 3 pixels wide, at depths that blocks of 4 to 8 pixels see several of, with gaps.
  const WorkspaceResult kept = image_of(200, 150, {525, 525, 99.5f, 74.5f}, [nan](int u, int v) {
    if ((u + v) % 11 == 0) return nan;
    return 0.3f + 0.02f * static_cast<float>(u / 3 % 4) + 0.004f * static_cast<float>(v / 5 % 2);
  });
  expect_means_of_near_points(kept.cloud, thin(kept));
}

TEST(ImageBlocks, WallsAlongTheLineOfSightKeepTheirPoints) {
  // 10 mm deeper with each pixel.
  const WorkspaceResult kept = image_of(100, 100, {525, 525, 49.5f, 49.5f},
                                        [](int u, int) { return 0.3f + 0.01f * static_cast<float>(u); });
  const Downsampled blocks = thin(kept);
  expect_means_of_near_points(kept.cloud, blocks);
  std::pmr::vector<float> depths(blocks.cloud.z.begin(), blocks.cloud.z.end());
  std::sort(depths.begin(), depths.end());
  EXPECT_EQ(std::unique(depths.begin(), depths.end(), [](float a, float b) { return b - a < 0.005f; }) -
                depths.begin(),
            100);
}

TEST(ImageBlocks, AnyDepth) {
  // A millimetre to kilometres: blocks have at most 16 pixels a side, and at least one.
  WorkspaceFilterConfig wide;
  wide.min_range_m = 0;
  wide.max_range_m = 100;
  wide.min_m.setConstant(-1000);
  wide.max_m.setConstant(1000);
  PointCloud cloud;
  for (int v = 0; v < 64; ++v)
    for (int u = 0; u < 64; ++u) {
      const float z = std::pow(10.0f, static_cast<float>((u * 7 + v * 3) % 5 - 3));
      cloud.push_back({static_cast<float>(u - 32) / 500 * z, static_cast<float>(v - 32) / 500 * z, z});
    }
  cloud.width = cloud.height = 64;
  const WorkspaceResult kept = filter_workspace(cloud, wide);
  const Downsampled blocks = thin(kept);
  ASSERT_EQ(blocks.voxel_of_point.size(), kept.cloud.size());
  for (std::size_t i = 0; i < kept.cloud.size(); ++i)
    ASSERT_LT(std::abs(kept.cloud.z[i] - blocks.cloud.z[blocks.voxel_of_point[i]]), 2 * kLeaf);
}

TEST(ImageBlocks, VoxelsWhereThereIsNoImageOrItIsNotAskedFor) {
  const AnalyticScene scene = three_objects();
  const PointCloud rotated = render(scene).cloud;
  const PointCloud optical = render(moved(scene, scene.camera.T_scene_camera.inverse())).cloud;
  const auto differs = [](const PointCloud& cloud, const DownsampleConfig& config) {
    const WorkspaceResult kept = filter_workspace(cloud, {});
    return downsample(kept.cloud, config, kept.pixels).voxel_of_point !=
           downsample(kept.cloud, {kLeaf}).voxel_of_point;
  };
  EXPECT_FALSE(differs(rotated, {kLeaf, true}));
  EXPECT_FALSE(differs(finite_points(optical), {kLeaf, true}));
  EXPECT_FALSE(differs(optical, {kLeaf, false}));
  EXPECT_TRUE(differs(optical, {kLeaf, true}));
}

}  // namespace
}  // namespace graspd

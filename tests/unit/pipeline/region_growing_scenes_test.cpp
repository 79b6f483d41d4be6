// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Region growing on rendered scenes: beside the paper's queue, and with one threshold instead of two.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <set>

#include "service/pipeline/region_growing.hpp"
#include "tests/support/clouds.hpp"
#include "tests/support/queue_growing.hpp"
#include "tests/support/scene_gallery.hpp"
#include "tests/unit/pipeline/voxel_surfaces.hpp"

namespace graspd {
namespace {

SmoothnessConfig thresholds(float low_deg, float high_deg, float share = 0.2f) {
  return {low_deg, high_deg, share};
}

// The order-free form and the paper's queue differ where an edge point lies between surfaces. The queue gives
// it to the surface that comes first, and grows on from it when it was reached from a point that is no edge
// point; the order-free form links it under theta_low alone, or else gives it to its most similar neighbour.
// On these scenes that is 0 to 3 % of the points, along the objects' edges
// - and as much as the queue differs from itself when its seeds come in another order.
TEST(RegionGrowingScenes, AgreesWithTheQueueOfThePaperAsMuchAsTheQueueWithItself) {
  constexpr int kOrders = 6;
  for (const AnalyticScene& scene :
       {box_on_table(), cylinder_on_table(), lying_cylinder_on_table(), three_objects()}) {
    const VoxelSurfaces s = voxel_surfaces(render(scene));
    const Labels labels = grow_regions(s.normals, s.neighborhoods, s.is_edge, {}, {});
    std::pmr::vector<std::uint32_t> seeds(s.cloud.size());
    std::iota(seeds.begin(), seeds.end(), 0u);
    std::mt19937 random(1);
    std::vector<std::pmr::vector<std::int32_t>> queues;
    for (int k = 0; k < kOrders; ++k) {
      queues.push_back(grow_by_queue(s.normals, s.neighborhoods, s.is_edge, {}, seeds));
      std::shuffle(seeds.begin(), seeds.end(), random);
    }
    double with_queue = 0, among_queues = 0;
    for (int k = 0; k < kOrders; ++k) {
      const auto& queue = queues[static_cast<std::size_t>(k)];
      const double share = agreement(labels.of_point, queue);
      EXPECT_GT(share, 0.965);
      with_queue += share / kOrders;
      among_queues += agreement(queue, queues[static_cast<std::size_t>((k + 1) % kOrders)]) / kOrders;
    }
    EXPECT_GT(with_queue, among_queues - 0.002);
  }
}

/// Number of labels that hold at least this share of a solid's points away from its edges.
std::set<std::int32_t> labels_of(const VoxelSurfaces& s, const Labels& labels, int solid,
                                 const Eigen::Vector3f& normal) {
  std::map<std::int32_t, int> count;
  int all = 0;
  for (std::size_t i = 0; i < s.cloud.size(); ++i) {
    if (s.solid[i] != solid || s.normals.at(i).dot(normal) < 0.99f) continue;
    ++count[labels.of_point[i]];
    ++all;
  }
  std::set<std::int32_t> large;
  for (const auto& [label, n] : count)
    if (10 * n > all) large.insert(label);
  return large;
}

AnalyticScene alone(AnalyticScene scene) {
  scene.solids.erase(scene.solids.begin());
  return scene;
}

AnalyticScene box_alone() {
  return alone(on_table({standing_box(0, 0, {0.10, 0.10, 0.08})}));
}

// The paper's figure on the effect of double thresholds.
TEST(RegionGrowingScenes, TwoThresholdsSeparateTheFacesOfABox) {
  const VoxelSurfaces s = voxel_surfaces(render(box_alone()));
  const Labels labels = grow_regions(s.normals, s.neighborhoods, s.is_edge, {}, {});
  const auto top = labels_of(s, labels, 0, Eigen::Vector3f::UnitZ());
  const auto front = labels_of(s, labels, 0, -Eigen::Vector3f::UnitY());
  ASSERT_EQ(top.size(), 1u);
  ASSERT_EQ(front.size(), 1u);
  EXPECT_NE(*top.begin(), *front.begin());
}

TEST(RegionGrowingScenes, ASingleHighThresholdMergesTheFacesOfABox) {
  const SmoothnessConfig single = thresholds(30, 30);
  const VoxelSurfaces s = voxel_surfaces(render(box_alone()), single);
  const Labels labels = grow_regions(s.normals, s.neighborhoods, s.is_edge, {}, single);
  EXPECT_EQ(labels_of(s, labels, 0, Eigen::Vector3f::UnitZ()),
            labels_of(s, labels, 0, -Eigen::Vector3f::UnitY()));
}

TEST(RegionGrowingScenes, ASingleLowThresholdSplitsACurvedSurfaceThatTwoKeepWhole) {
  // k = 1: without edge points, region growing as it was before the paper.
  const SmoothnessConfig low = thresholds(4, 4, 1), both = thresholds(4, 15);
  const RenderedScene rendered = render(alone(lying_cylinder_on_table()));
  const VoxelSurfaces s = voxel_surfaces(rendered, low), t = voxel_surfaces(rendered, both);
  EXPECT_EQ(grow_regions(t.normals, t.neighborhoods, t.is_edge, {}, both).num_labels, 1);
  EXPECT_GT(grow_regions(s.normals, s.neighborhoods, s.is_edge, {}, low).num_labels, 10);
}

TEST(RegionGrowingScenes, ASingleLowThresholdLeavesPatchesOnANoisySurface) {
  const SmoothnessConfig low = thresholds(4, 4, 1), both = thresholds(4, 15);
  RenderedScene rendered = render(box_alone());
  rendered.cloud = with_range_noise(rendered.cloud, 0.0012f, 7);
  const VoxelSurfaces s = voxel_surfaces(rendered, low), t = voxel_surfaces(rendered, both);
  EXPECT_EQ(grow_regions(t.normals, t.neighborhoods, t.is_edge, {}, both).num_labels, 2);
  EXPECT_GT(grow_regions(s.normals, s.neighborhoods, s.is_edge, {}, low).num_labels, 20);
}

}  // namespace
}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/solid_probe.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "client/simulate/rng.hpp"
#include "client/simulate/scene_builder.hpp"
#include "tests/unit/evaluate/solid_scenes.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;

struct Probed {
  Eigen::Isometry3d T_world_box = Eigen::Isometry3d::Identity();
  Eigen::AlignedBox3d box;
};

Probed random_box(Rng& rng) {
  Probed probed;
  probed.T_world_box.translation() =
      Vector3d(rng.uniform(-0.2, 0.2), rng.uniform(-0.15, 0.15), rng.uniform(0, 0.2));
  probed.T_world_box.rotate(
      Eigen::Quaterniond(rng.normal(), rng.normal(), rng.normal(), rng.normal()).normalized());
  probed.box.extend(Vector3d(-0.01, -0.005, -0.03));
  probed.box.extend(Vector3d(0.01, 0.005, rng.uniform(0, 0.05)));
  return probed;
}

/// The deepest of a dense grid's points.
double sampled_depth(const Solid& solid, const Probed& probed) {
  constexpr int kSteps = 20;
  double depth = -1;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j)
      for (int k = 0; k <= kSteps; ++k) {
        const Vector3d share = Vector3d(i, j, k) / kSteps;
        const Vector3d p = probed.box.min() + share.cwiseProduct(probed.box.sizes());
        depth = std::max(depth, -signed_distance(solid, probed.T_world_box * p));
      }
  return depth;
}

TEST(SolidProbe, AgreesWithDenseSamples) {
  Rng rng(5);
  const Scene scene = build_scene({SceneKind::kExtreme, {}}, 3);
  const SolidProbe probe(scene);
  int hits = 0;
  for (int i = 0; i < 60; ++i) {
    const Probed probed = random_box(rng);
    const auto near = probe.near(probed.T_world_box, probed.box);
    for (std::size_t s = 0; s < scene.solids.size(); ++s) {
      const Solid& solid = scene.solids[s];
      const double depth = sampled_depth(solid, probed);
      const bool found =
          reaches_into(solid, solid.T_world_solid.inverse() * probed.T_world_box, probed.box, 0.001);
      hits += found ? 1 : 0;
      EXPECT_TRUE(found || depth <= 0.001) << solid.kind;
      // The grid's points are at most 3 mm from any other.
      EXPECT_TRUE(!found || depth > -0.003) << solid.kind;
      EXPECT_TRUE(!found || std::find(near.begin(), near.end(), s) != near.end());
    }
  }
  EXPECT_GT(hits, 20);
}

TEST(SolidProbe, APadMeetsTheNearestSolidFirst) {
  Scene scene = bare_table();
  add_body(scene, Box{{0, 0, 0}, {0.01, 0.01, 0.02}}, {0, 0.03, 0.1});
  add_body(scene, Box{{0, 0, 0}, {0.02, 0.01, 0.02}}, {0, 0.06, 0.1});
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation().z() = 0.1;
  PadSweep sweep;
  sweep.face.extend(Vector3d(-0.016, 0, -0.016));
  sweep.face.extend(Vector3d(0.016, 0, 0.016));
  sweep.direction = 1;
  sweep.reach_m = 0.055;
  const std::vector<std::size_t> both{2, 1};
  const auto hits = sweep_pad(scene, both, T, sweep);
  ASSERT_EQ(hits.size(), 16u * 16u);
  for (const PadHit& hit : hits) {
    if (hit.solid == kNoSolid) continue;
    const bool middle = std::abs(hit.spot.x()) < 0.01;
    EXPECT_EQ(hit.solid, middle ? 1u : 2u);
    EXPECT_NEAR(hit.travel_m, middle ? 0.02 : 0.05, 1e-9);
    EXPECT_NEAR(hit.spot.y(), hit.travel_m, 1e-9);
    EXPECT_NEAR(hit.normal.y(), -1, 1e-9);
  }
  EXPECT_EQ(hits.front().solid, 2u);
  EXPECT_EQ(hits[8 * 16 + 8].solid, 1u);
  sweep.reach_m = 0.04;
  EXPECT_EQ(sweep_pad(scene, both, T, sweep).front().solid, kNoSolid);
}

}  // namespace
}  // namespace graspd

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/simulate/scene_builder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "client/simulate/rng.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;

bool same(const Solid& a, const Solid& b) {
  return a.kind == b.kind && a.label == b.label && a.rgb == b.rgb && a.parts.size() == b.parts.size() &&
         a.T_world_solid.matrix() == b.T_world_solid.matrix();
}

/// Random points inside a solid, in the world frame.
std::vector<Vector3d> points_inside(const Solid& solid, int tries, Rng& rng) {
  std::vector<Vector3d> points;
  for (const Convex& part : solid.parts) {
    const Eigen::AlignedBox3d box = bounds(part);
    for (int i = 0; i < tries; ++i) {
      const Vector3d share(rng.uniform(), rng.uniform(), rng.uniform());
      const Vector3d p = solid.T_world_solid * Vector3d(box.min() + share.cwiseProduct(box.sizes()));
      if (signed_distance(solid, p) < 0) points.push_back(p);
    }
  }
  return points;
}

TEST(SceneBuilder, NothingGoesThroughAnythingElse) {
  Rng rng(10);
  for (const SceneKind kind : {SceneKind::kTable, SceneKind::kBin}) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
      const Scene scene = build_scene({kind, 14}, seed);
      for (std::size_t i = 0; i < scene.solids.size(); ++i) {
        for (const Vector3d& p : points_inside(scene.solids[i], 100, rng)) {
          for (std::size_t j = 0; j < scene.solids.size(); ++j) {
            if (j == i) continue;
            EXPECT_GE(signed_distance(scene.solids[j], p), -1e-9)
                << "seed " << seed << ": " << scene.solids[i].kind << " in " << scene.solids[j].kind;
          }
        }
      }
    }
  }
}

TEST(SceneBuilder, EveryObjectStandsOnSomething) {
  Rng rng(11);
  for (const SceneKind kind : {SceneKind::kTable, SceneKind::kBin}) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
      const Scene scene = build_scene({kind, 14}, seed);
      for (const Solid& solid : scene.solids) {
        if (solid.label < object_label(kFirstObject)) continue;
        const auto points = points_inside(solid, 2000, rng);
        const auto lowest = *std::min_element(points.begin(), points.end(),
                                              [](const auto& a, const auto& b) { return a.z() < b.z(); });
        // Random points end a little above the bottom.
        bool carried = false;
        for (const Solid& other : scene.solids) {
          carried |= &other != &solid && signed_distance(other, lowest - Vector3d(0, 0, 0.006)) < 0;
        }
        EXPECT_TRUE(carried) << "seed " << seed << ": " << solid.kind << " at " << lowest.transpose();
      }
    }
  }
}

TEST(SceneBuilder, LabelsAreThoseOfTheConvention) {
  const Scene scene = build_scene({SceneKind::kBin, 10}, 4);
  std::uint32_t next = 20;
  int walls = 0;
  for (const Solid& solid : scene.solids) {
    if (solid.kind == "table" || solid.kind == "floor") {
      EXPECT_EQ(solid.label, 1u);
    } else if (solid.kind == "bin_wall") {
      EXPECT_EQ(solid.label, 2u);
      ++walls;
    } else {
      EXPECT_EQ(solid.label, next);
      next += 10;
    }
  }
  EXPECT_EQ(walls, 4);
  EXPECT_EQ(num_objects(scene), static_cast<int>(next / 10 - 2));
}

TEST(SceneBuilder, SameSeedSameScene) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Scene a = build_scene({SceneKind::kTable, 8}, seed);
    const Scene b = build_scene({SceneKind::kTable, 8}, seed);
    ASSERT_EQ(a.solids.size(), b.solids.size());
    for (std::size_t i = 0; i < a.solids.size(); ++i) EXPECT_TRUE(same(a.solids[i], b.solids[i]));
    const Scene other = build_scene({SceneKind::kTable, 8}, seed + 1);
    EXPECT_FALSE(same(a.solids.back(), other.solids.back()));
  }
}

TEST(SceneBuilder, TablesAreCluttered) {
  std::set<std::string> kinds;
  int objects = 0;
  int stacked = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const Scene scene = build_scene({SceneKind::kTable, 8}, seed);
    objects += num_objects(scene);
    for (const Solid& solid : scene.solids) {
      if (solid.label < object_label(kFirstObject)) continue;
      kinds.insert(solid.kind);
      const auto box = bounds(solid.parts[0]);
      const double bottom =
          std::min((solid.T_world_solid * box.min()).z(), (solid.T_world_solid * box.max()).z());
      stacked += bottom > 0.005;
    }
  }
  EXPECT_EQ(objects, 30 * 8);
  EXPECT_EQ(kinds.size(), 8u);
  EXPECT_GT(stacked, 5);
}

TEST(SceneBuilder, AskingForTooMuchGivesWhatFits) {
  const Scene scene = build_scene({SceneKind::kBin, 200}, 1);
  EXPECT_GT(num_objects(scene), 10);
  EXPECT_LT(num_objects(scene), 200);
}

TEST(SceneBuilder, EmptyIsEmpty) {
  EXPECT_EQ(num_objects(build_scene({SceneKind::kEmpty, 8}, 1)), 0);
  EXPECT_EQ(num_objects(build_scene({SceneKind::kTable, 0}, 1)), 0);
}

}  // namespace
}  // namespace graspd

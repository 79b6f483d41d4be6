// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/simulate/scene.hpp"

#include <gtest/gtest.h>

#include "client/simulate/household_models.hpp"
#include "client/simulate/object_models.hpp"
#include "client/simulate/rng.hpp"
#include "client/simulate/scene_builder.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;

TEST(Scene, RaysStopAtTheFirstMatterAndNotBefore) {
  Rng rng(6);
  for (const SceneKind kind : {SceneKind::kTable, SceneKind::kBin}) {
    const Scene scene = build_scene({kind, 12}, 3);
    for (int i = 0; i < 1500; ++i) {
      const Vector3d origin(rng.uniform(-0.5, 0.5), rng.uniform(-0.5, 0.5), rng.uniform(0.4, 0.9));
      const Vector3d target(rng.uniform(-0.3, 0.3), rng.uniform(-0.2, 0.2), rng.uniform(0, 0.15));
      const Ray ray{origin, target - origin};
      const auto hit = cast(scene, ray);
      ASSERT_TRUE(hit) << "the room has a floor";
      EXPECT_NEAR(signed_distance(scene.solids[hit->solid], ray.at(hit->t)), 0, 1e-9);
      EXPECT_LE(hit->normal.dot(ray.direction), 1e-9);
      for (int k = 0; k < 100; ++k) EXPECT_GE(signed_distance(scene, ray.at(hit->t * rng.uniform())), -1e-9);
      EXPECT_LT(signed_distance(scene.solids[hit->solid], ray.at(hit->t) - 1e-6 * hit->normal), 0);
    }
  }
}

TEST(Scene, BowlsAndMugsAreHollow) {
  Rng rng(7);
  for (const ObjectModel& model : {make_bowl(rng), make_mug(rng)}) {
    const Scene scene{{model.solid}};
    const auto hit = cast(scene, Ray{{0, 0, 1}, {0, 0, -1}});
    ASSERT_TRUE(hit);
    const double bottom = 1 - hit->t;
    EXPECT_GT(bottom, 0.0001) << model.solid.kind << " has a bottom";
    EXPECT_LT(bottom, 0.008) << model.solid.kind << " is open at the top";
    EXPECT_GT(hit->normal.z(), 0.99);
    EXPECT_GT(signed_distance(scene, {0, 0, bottom + 0.01}), 0);
    EXPECT_LT(signed_distance(scene, {0, 0, bottom / 2}), 0);
  }
}

TEST(Scene, TheMugsHandleHasAHole) {
  Rng rng(8);
  const ObjectModel mug = make_mug(rng);
  const double radius = std::get<Cylinder>(mug.solid.parts[0]).radius;
  const double middle = std::get<Cylinder>(mug.solid.parts[0]).z_max / 2;
  const Scene scene{{mug.solid}};
  EXPECT_FALSE(cast(scene, Ray{{radius + 0.008, 1, middle}, {0, -1, 0}})) << "a finger fits through";
  const double outside = mug.footprints[1].center.x() + mug.footprints[1].half.x();
  EXPECT_TRUE(cast(scene, Ray{{outside - 0.002, 1, middle}, {0, -1, 0}})) << "the ring is behind it";
}

TEST(Scene, ObjectsRestOnTheGroundWithinTheirFootprints) {
  const std::vector<ObjectMaker> makers{make_box,         make_book,    make_can,    make_lying_can,
                                        make_bottle,      make_ball,    make_bowl,   make_mug,
                                        make_screwdriver, make_hammer,  make_banana, make_goblet,
                                        make_pan,         make_bracket, make_ring,   make_dumbbell};
  Rng rng(9);
  for (const ObjectMaker make : makers) {
    for (int i = 0; i < 20; ++i) {
      const ObjectModel model = make(rng);
      Eigen::AlignedBox3d whole;
      for (const Convex& part : model.solid.parts) {
        const Eigen::AlignedBox3d box = bounds(part);
        for (int c = 0; c < 8; ++c)
          whole.extend(model.solid.T_world_solid *
                       box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(c)));
      }
      EXPECT_NEAR(whole.min().z(), 0, 1e-12) << model.solid.kind;
      const Vector3d low = whole.min() - Vector3d::Constant(0.02),
                     size = whole.sizes() + Vector3d::Constant(0.04);
      double lowest = 1;
      int inside = 0;
      for (int k = 0; k < 16000; ++k) {
        const Vector3d p = low + size.cwiseProduct(Vector3d(rng.uniform(), rng.uniform(), rng.uniform()));
        if (signed_distance(model.solid, p) >= 0) continue;
        ++inside;
        lowest = std::min(lowest, p.z());
        const auto covers = [&](const Footprint& f) {
          Footprint point;
          point.center = p.head<2>();
          return clearance(f, point) <= 1e-9 && p.z() >= f.z_min && p.z() <= f.z_max;
        };
        EXPECT_TRUE(std::any_of(model.footprints.begin(), model.footprints.end(), covers))
            << model.solid.kind;
      }
      EXPECT_GT(inside, 100) << model.solid.kind;
      EXPECT_GE(lowest, 0) << model.solid.kind;
    }
  }
}

}  // namespace
}  // namespace graspd

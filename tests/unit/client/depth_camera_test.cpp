// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/simulate/depth_camera.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "client/simulate/rng.hpp"
#include "client/simulate/scene_builder.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;

/// Each pixel of a sample against a ray of its own through the whole scene.
void expect_same_as_cast(const Scene& scene, const Pinhole& camera, const Eigen::Isometry3d& T_world_camera) {
  const DepthFrame frame = render(scene, camera, T_world_camera);
  Rng rng(12);
  for (int k = 0; k < 3000; ++k) {
    const int u = rng.index(camera.width);
    const int v = rng.index(camera.height);
    const Vector3d direction((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1);
    const auto hit = cast(scene, Ray{T_world_camera.translation(), T_world_camera.linear() * direction});
    const auto i = static_cast<std::size_t>(v * camera.width + u);
    if (!hit) {
      EXPECT_EQ(frame.depth_m[i], 0);
      EXPECT_EQ(frame.label[i], kLabelInvalid);
      continue;
    }
    EXPECT_NEAR(frame.depth_m[i], hit->t, 1e-6) << u << ' ' << v;
    // On the seam between two solids either may be first.
    if (signed_distance(scene, T_world_camera * (hit->t * direction) + 1e-7 * hit->normal) > 0) {
      EXPECT_EQ(frame.label[i], scene.solids[hit->solid].label) << u << ' ' << v;
    }
  }
}

TEST(DepthCamera, EachPixelSeesWhatItsRayMeetsFirst) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const SceneKind kind = seed % 2 ? SceneKind::kBin : SceneKind::kTable;
    expect_same_as_cast(build_scene({kind, 10}, seed), Pinhole{}, look_at({0.2, -0.6, 0.6}, {0, 0, 0}));
  }
}

TEST(DepthCamera, CloseAndAmongTheObjects) {
  // Solids beside and behind the camera.
  expect_same_as_cast(build_scene({SceneKind::kTable, 14}, 5), Pinhole{160, 120, 90, 90, 79.5, 59.5},
                      look_at({0.05, -0.3, 0.25}, {0, 0.2, 0}));
}

TEST(DepthCamera, LooksStraightDown) {
  const Eigen::Isometry3d T = look_at({0, 0, 1}, {0, 0, 0});
  EXPECT_NEAR(T.linear().determinant(), 1, 1e-12);
  const DepthFrame frame = render(build_scene({SceneKind::kEmpty, 0}, 0), Pinhole{}, T);
  EXPECT_NEAR(frame.depth_m[240 * 640 + 320], 1, 1e-6);
  EXPECT_NEAR(frame.cos_incidence[240 * 640 + 320], 1, 1e-5);
}

TEST(DepthCamera, TheWorldsUpIsUpInTheImage) {
  const Eigen::Isometry3d T = look_at({0.5, -0.5, 0.5}, {0, 0, 0});
  EXPECT_LT(T.linear().col(1).z(), 0) << "y points down";
  EXPECT_NEAR(T.linear().col(0).z(), 0, 1e-12) << "x is level";
  EXPECT_NEAR((T * Vector3d(0, 0, std::sqrt(0.75))).norm(), 0, 1e-12);
}

TEST(DepthCamera, CloudPointsLieOnTheSolidsOfTheirLabels) {
  const Scene scene = build_scene({SceneKind::kTable, 10}, 6);
  const Eigen::Isometry3d T_world_camera = look_at({0.2, -0.6, 0.6}, {0, 0, 0});
  const LabelledCloud labelled = to_cloud(render(scene, Pinhole{}, T_world_camera));
  ASSERT_EQ(labelled.cloud.size(), 640u * 480u);
  ASSERT_EQ(labelled.label.size(), labelled.cloud.size());
  std::size_t objects = 0;
  for (std::size_t i = 0; i < labelled.cloud.size(); i += 7) {
    if (labelled.label[i] == kLabelInvalid) {
      EXPECT_TRUE(std::isnan(labelled.cloud.z[i]));
      continue;
    }
    const Vector3d p = T_world_camera * labelled.cloud.point(i).cast<double>();
    double nearest = 1;
    for (const Solid& solid : scene.solids) {
      if (solid.label == labelled.label[i]) nearest = std::min(nearest, std::abs(signed_distance(solid, p)));
    }
    EXPECT_LT(nearest, 1e-6);
    objects += labelled.label[i] >= 20;
  }
  EXPECT_GT(objects, 1000u);
}

}  // namespace
}  // namespace graspd

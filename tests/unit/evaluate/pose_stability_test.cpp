// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <numbers>

#include "client/evaluate/scene_runs.hpp"

namespace graspd {
namespace {

Handle turned(const Handle& handle, float degrees, const Eigen::Vector3f& axis) {
  Handle other = handle;
  other.rotation =
      handle.rotation * Eigen::AngleAxisf(degrees * std::numbers::pi_v<float> / 180, axis).matrix();
  return other;
}

TEST(PoseMove, MeasuresDistanceAndAngle) {
  Handle handle;
  handle.rotation = Eigen::AngleAxisf(0.7f, Eigen::Vector3f(1, 2, 3).normalized()).matrix();
  Handle other = handle;
  other.position = {0.003f, 0, 0.004f};
  EXPECT_NEAR(pose_move(handle, other).distance_m, 0.005, 1e-6);
  EXPECT_NEAR(pose_move(handle, other).angle_deg, 0, 0.1);
  EXPECT_NEAR(pose_move(handle, turned(handle, 10, Eigen::Vector3f::UnitX())).angle_deg, 10, 0.1);
  EXPECT_NEAR(pose_move(handle, turned(handle, 90, Eigen::Vector3f::UnitZ())).angle_deg, 90, 0.1);
}

TEST(PoseMove, AGripperTurnedByHalfATurnIsTheSame) {
  const Handle handle;
  const Handle half = turned(handle, 180, Eigen::Vector3f::UnitZ());
  EXPECT_NEAR(pose_move(handle, half).angle_deg, 0, 0.1);
  EXPECT_NEAR(pose_move(handle, turned(half, -7, Eigen::Vector3f::UnitY())).angle_deg, 7, 0.1);
  EXPECT_NEAR(pose_move(handle, turned(handle, 180, Eigen::Vector3f::UnitX())).angle_deg, 180, 0.1);
}

TEST(PoseStability, FollowsTheBestHandleOfEachObject) {
  SimulationConfig config;
  config.scene.kind = SceneKind::kEasy;
  config.camera = scaled(config.camera, 160);
  // On two objects; on the first it moves by 2 mm a frame, on the second there is one in even frames only.
  const auto handles = [](const TrueFrame& truth) {
    const auto at = [&](std::size_t object, float aside_m) {
      Handle handle;
      const Solid& solid = truth.scene.solids[truth.scene.solids.size() - object];
      handle.position = (truth.T_world_camera.inverse() * solid.T_world_solid.translation()).cast<float>();
      handle.position.x() += aside_m;
      return handle;
    };
    std::pmr::vector<Handle> list{at(1, 0.002f * static_cast<float>(truth.seq)), at(1, 0.02f)};
    if (truth.seq % 2 == 0) list.push_back(at(2, 0));
    return list;
  };
  const auto objects = pose_stability(config, 5, handles);
  ASSERT_EQ(objects.size(), 2u);
  const ObjectStability& last = objects[1];
  EXPECT_EQ(last.frames_with_handle, 4);
  ASSERT_EQ(last.moves.size(), 4u);
  EXPECT_NEAR(last.moves[0].distance_m, 0.002, 1e-5);
  EXPECT_NEAR(last.moves[3].distance_m, 0.008, 1e-5);
  EXPECT_EQ(objects[0].frames_with_handle, 2);
  const Table table = stability_table(objects, 5);
  ASSERT_EQ(table.rows.size(), 3u);
  EXPECT_EQ(std::get<Percentage>(table.rows[0][3]).value, 0.5);
  EXPECT_EQ(std::get<Percentage>(table.rows[2][3]).value, 0.75);
  EXPECT_NEAR(std::get<double>(table.rows[1][4]), 4, 1e-2) << "median of 2, 4, 6, 8 by nearest rank, in mm";
}

}  // namespace
}  // namespace graspd

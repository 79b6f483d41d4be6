// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/judged_scene.hpp"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include "client/evaluate/scene_runs.hpp"
#include "client/evaluate/simulate_mode.hpp"

namespace graspd {
namespace {

SimulationConfig small_simulation(const std::string& kind) {
  SimulateOptions options;
  options.kind = kind;
  SimulationConfig config = simulation_config(options);
  config.camera = scaled(config.camera, 320);
  config.seed = 5;
  return config;
}

/// The poses of the search, as a detector that knows everything would publish them.
std::pmr::vector<Handle> perfect_handles(const TrueFrame& truth) {
  const SolidJudge judge(truth.scene, Gripper{});
  std::pmr::vector<Handle> handles;
  for (const GraspableSolid& object : graspable_solids(judge, truth.ideal, truth.T_world_camera)) {
    if (!object.graspable) continue;
    for (const Handle& pose : object.poses)
      handles.push_back(transformed(pose, truth.T_world_camera.inverse().cast<float>()));
  }
  return handles;
}

std::vector<JudgedScene> judged(const HandlesOfFrame& handles, const SceneRange& range) {
  return judge_scenes(small_simulation("medium"), range, Gripper{}, handles, "medium");
}

TEST(TrueFrame, IsTheSimulatorsFrame) {
  for (const char* kind : {"easy", "extreme"}) {
    Simulation simulation(small_simulation(kind));
    for (std::int64_t k = 0; k < 3; ++k) {
      const DepthFrame frame = simulation.frame(k);
      const TrueFrame truth = true_frame(small_simulation(kind), k);
      EXPECT_EQ(truth.measured.depth_m, frame.depth_m);
      EXPECT_EQ(truth.measured.label, frame.label);
      EXPECT_EQ(truth.ideal.depth_m, render(truth.scene, frame.camera, truth.T_world_camera).depth_m);
      EXPECT_EQ(truth.scene.solids.size(), simulation.scene().solids.size());
      EXPECT_NE(truth.measured.depth_m, truth.ideal.depth_m);
    }
  }
}

TEST(JudgedScene, WhatTheSearchFindsIsJudgedToHold) {
  int objects = 0;
  for (const JudgedScene& scene : judged(perfect_handles, {0, 4})) {
    const Figures f = figures(scene.frame);
    objects += f.objects;
    EXPECT_EQ(f.objects_found, f.objects);
    EXPECT_EQ(f.valid_handles, f.handles);
    EXPECT_EQ(scene.handles.size(), scene.frame.handles.size());
    for (const SceneHandle& handle : scene.handles) EXPECT_GE(handle.undisturbed, 7) << handle.explanation;
  }
  EXPECT_GT(objects, 10);
}

TEST(JudgedScene, TellsWhatFailsAndWhatIsMissed) {
  const auto spoilt = [](const TrueFrame& truth) {
    std::pmr::vector<Handle> handles = perfect_handles(truth);
    handles.resize(1);
    handles.push_back(handles.front());
    handles.back().width_m = 0;  // The fingers go into the object.
    return handles;
  };
  const auto scenes = judged(spoilt, {2, 1});
  ASSERT_EQ(scenes.size(), 1u);
  const JudgedScene& scene = scenes.front();
  EXPECT_EQ(scene.frame.name, "2");
  EXPECT_EQ(scene.frame.category, "medium");
  ASSERT_EQ(scene.frame.handles.size(), 2u);
  EXPECT_TRUE(scene.frame.handles[0].valid);
  EXPECT_FALSE(scene.frame.handles[1].valid);
  EXPECT_EQ(scene.frame.handles[1].failure, "finger");
  EXPECT_EQ(scene.frame.handles[1].object, scene.frame.handles[0].object);
  const Table failed = failed_handle_table(scenes);
  ASSERT_EQ(failed.rows.size(), 1u);
  EXPECT_EQ(std::get<std::string>(failed.rows[0][0]), "2");
  EXPECT_EQ(std::get<std::int64_t>(failed.rows[0][1]), 1);
  EXPECT_EQ(failed.rows[0].size(), failed.columns.size());
  const Table missed = missed_object_table(scenes);
  EXPECT_EQ(missed.rows.size(), scene.frame.objects.size() - 1);
  EXPECT_EQ(missed.rows[0].size(), missed.columns.size());
}

TEST(JudgedScene, TheBinsWallsAreLeftOut) {
  const SimulationConfig config = small_simulation("extreme");
  const TrueFrame truth = true_frame(config, 0);
  // From above, across the top of the bin's right wall.
  Handle wall;
  wall.position = {0.264f, 0, 0.14f};
  wall.rotation << 0, 1, 0, 1, 0, 0, 0, 0, -1;
  wall.width_m = 0.008f;
  bool left_out = false;
  const SolidJudge judge(truth.scene, Gripper{});
  for (float y = -0.15f; y < 0.16f && !left_out; y += 0.01f) {
    wall.position.y() = y;
    const Handle seen = transformed(wall, truth.T_world_camera.inverse().cast<float>());
    const JudgedScene scene = judge_scene(truth, {seen}, judge, "");
    left_out = scene.wall_handles == 1 && scene.frame.handles.empty() && scene.handles.empty();
  }
  EXPECT_TRUE(left_out);
}

TEST(JudgedScene, KindsAddUp) {
  const auto scenes = judged(perfect_handles, {0, 3});
  std::int64_t graspable = 0, objects = 0;
  for (const auto& row : kind_table(scenes).rows) graspable += std::get<std::int64_t>(row[2]);
  for (const JudgedScene& scene : scenes) objects += static_cast<std::int64_t>(scene.frame.objects.size());
  EXPECT_EQ(graspable, objects);
  EXPECT_EQ(worst_scene_table(scenes, 2).rows.size(), 2u);
}

TEST(JudgeScenes, DoesNotDependOnThreads) {
  const DetectionRun run{"graspd", Gripper{}, DetectConfig{}, {}};
  const EvaluatedRun evaluated{"graspd", Gripper{}, run};
  const auto with_threads = [&](int threads) {
    tbb::task_arena arena(threads);
    return arena.execute([&] {
      return judged(handle_source(evaluated, Eigen::Isometry3f::Identity()), {0, 3});
    });
  };
  const auto one = with_threads(1), two = with_threads(2);
  int handles = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].frame.objects, two[i].frame.objects);
    ASSERT_EQ(one[i].handles.size(), two[i].handles.size());
    for (std::size_t k = 0; k < one[i].handles.size(); ++k, ++handles)
      EXPECT_EQ(one[i].handles[k].explanation, two[i].handles[k].explanation);
  }
  EXPECT_GT(handles, 5);
}

TEST(JudgeScenes, AFramesHandlesAreLookedUpByItsNumber) {
  HandleFile file;
  file.by_seq[1] = perfect_handles(true_frame(small_simulation("medium"), 1));
  const EvaluatedRun run{"file", Gripper{}, file};
  const auto scenes = judged(handle_source(run, Eigen::Isometry3f::Identity()), {0, 2});
  EXPECT_FALSE(scenes[0].has_list);
  EXPECT_TRUE(scenes[0].frame.handles.empty());
  EXPECT_TRUE(scenes[1].has_list);
  EXPECT_EQ(scenes[1].frame.handles.size(), file.by_seq[1].size());
  EXPECT_EQ(figures(scenes[1].frame).recall(), 1.0);
}

}  // namespace
}  // namespace graspd

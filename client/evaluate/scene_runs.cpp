// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/scene_runs.hpp"

#include <tbb/parallel_for.h>

#include <mutex>

#include "service/pipeline/detect_handles.hpp"

namespace graspd {

HandlesOfFrame detector(const Gripper& gripper, const DetectConfig& config) {
  return [=](const TrueFrame& truth) {
    return detect_handles(to_cloud(truth.measured).cloud, gripper, config).handles;
  };
}

std::vector<JudgedScene> judge_scenes(const SimulationConfig& simulation, const SceneRange& range,
                                      const Gripper& gripper, const HandlesOfFrame& handles,
                                      const std::string& category, const Progress& progress) {
  std::vector<JudgedScene> scenes(static_cast<std::size_t>(range.num));
  std::mutex mutex;
  std::int64_t done = 0;
  tbb::parallel_for(std::size_t{0}, scenes.size(), [&](std::size_t i) {
    const TrueFrame truth = true_frame(simulation, range.first + static_cast<std::int64_t>(i));
    const SolidJudge judge(truth.scene, gripper);
    scenes[i] = judge_scene(truth, handles(truth), judge, category);
    const std::lock_guard lock(mutex);
    if (progress) progress(++done);
  });
  return scenes;
}

}  // namespace graspd

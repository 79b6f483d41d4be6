// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/scene_runs.hpp"

#include <tbb/parallel_for.h>

#include <mutex>

#include "service/pipeline/detect_handles.hpp"

namespace graspd {
namespace {

HandlesOfFrame detected(const DetectionRun& run) {
  return [&run](const TrueFrame& truth) {
    const PointCloud cloud = changed(to_cloud(truth.measured).cloud, run.change);
    return detect_handles(cloud, run.gripper, run.detect).handles;
  };
}

HandlesOfFrame looked_up(const HandleFile& file, const Eigen::Isometry3f& T_cloud_handles) {
  return [&file, T_cloud_handles](const TrueFrame& truth) -> std::optional<std::pmr::vector<Handle>> {
    const auto* listed = file.find(truth.seq);
    if (listed == nullptr) return std::nullopt;
    std::pmr::vector<Handle> handles = *listed;
    for (Handle& handle : handles) handle = transformed(handle, T_cloud_handles);
    return handles;
  };
}

}  // namespace

HandlesOfFrame handle_source(const EvaluatedRun& run, const Eigen::Isometry3f& T_cloud_handles) {
  if (const auto* file = std::get_if<HandleFile>(&run.handles)) return looked_up(*file, T_cloud_handles);
  if (const auto* either = std::get_if<LoggedOrDetected>(&run.handles)) return detected(either->run);
  return detected(std::get<DetectionRun>(run.handles));
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
    const auto found = handles(truth);
    scenes[i] = judge_scene(truth, found.value_or(std::pmr::vector<Handle>()), judge, category);
    scenes[i].has_list = found.has_value();
    const std::lock_guard lock(mutex);
    if (progress) progress(++done);
  });
  return scenes;
}

}  // namespace graspd

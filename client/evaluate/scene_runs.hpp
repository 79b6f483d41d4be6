// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Detection over many simulated scenes, judged on their solids.
#pragma once
#include <cstdint>
#include <functional>
#include <memory_resource>
#include <optional>
#include <string>
#include <vector>

#include "client/evaluate/evaluator.hpp"
#include "client/evaluate/judged_scene.hpp"

namespace graspd {

/// Handles of a frame in the camera's frame, best first; nothing where a file of handles does not name it.
using HandlesOfFrame = std::function<std::optional<std::pmr::vector<Handle>>(const TrueFrame&)>;

/// Detected with the run's settings, or looked up in its file by the frame's number. T_cloud_handles takes
/// handles of files back into the camera's frame. The run must outlive it.
[[nodiscard]] HandlesOfFrame handle_source(const EvaluatedRun& run, const Eigen::Isometry3f& T_cloud_handles);

struct SceneRange {
  std::int64_t first = 0;
  std::int64_t num = 20;
};

/// Called after each frame with the number of those that are done; one call at a time.
using Progress = std::function<void(std::int64_t)>;

/// One judged scene a frame, in order. Work is split over the calling thread's oneTBB arena; the result does
/// not depend on it. category: of the frames, for tables.
[[nodiscard]] std::vector<JudgedScene> judge_scenes(const SimulationConfig& simulation,
                                                    const SceneRange& range, const Gripper& gripper,
                                                    const HandlesOfFrame& handles,
                                                    const std::string& category,
                                                    const Progress& progress = {});

/// How far apart two poses are, where half a turn about the approach changes nothing.
struct PoseMove {
  double distance_m = 0;
  double angle_deg = 0;
};
[[nodiscard]] PoseMove pose_move(const Handle& from, const Handle& to);

/// How the best handle of one object moves over noisy frames of a static scene.
struct ObjectStability {
  std::uint64_t seed = 0;
  std::uint32_t label = 0;
  std::string kind;
  int frames_with_handle = 0;   ///< of those after the first
  std::vector<PoseMove> moves;  ///< from the first frame's
};

/// For each object with a handle in frame 0 of a scene that stays: its best handle in frames 1 to frames - 1.
[[nodiscard]] std::vector<ObjectStability> pose_stability(SimulationConfig simulation, std::int64_t frames,
                                                          const HandlesOfFrame& handles);

/// A row an object and one for all: medians of the movements, share of the frames with a handle.
[[nodiscard]] Table stability_table(const std::vector<ObjectStability>& objects, std::int64_t frames);

}  // namespace graspd

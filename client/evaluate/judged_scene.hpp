// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Handles of a simulated frame against the solids it shows.
#pragma once
#include <cstdint>
#include <memory_resource>
#include <string>
#include <vector>

#include "client/evaluate/evaluation.hpp"
#include "client/evaluate/graspable_solids.hpp"
#include "client/evaluate/tables.hpp"
#include "client/simulate/simulation.hpp"

namespace graspd {

/// A simulated frame and the truth behind it.
struct TrueFrame {
  std::int64_t seq = 0;
  Scene scene;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  DepthFrame ideal;     ///< without the sensor's noise
  DepthFrame measured;  ///< what graspd-simulate publishes with this number
};

[[nodiscard]] TrueFrame true_frame(const SimulationConfig& config, std::int64_t seq);

/// An object that is seen enough to count, and whether the gripper can hold it.
struct SceneObject {
  GraspableSolid found;
  std::string kind;
};

/// A handle in the world frame, and what became of it.
struct SceneHandle {
  Handle handle_world;
  SolidVerdict verdict;
  int undisturbed = 0;      ///< of 12 disturbances that it holds in; 0 when it does not hold
  std::string explanation;  ///< one line
};

struct JudgedScene {
  JudgedFrame frame;  ///< its name is the frame's number; objects are labels; handles in the camera's frame
  std::vector<SceneObject> objects;
  std::vector<SceneHandle> handles;  ///< in the order of the frame's
  bool has_list = true;              ///< false: the file of handles does not name the frame
  int wall_handles = 0;  ///< with a wall of the bin between the jaws: no object, so not in the frame
};

/// The object whose surface is nearest to a point, or that the point is in; kNoSolid without objects.
[[nodiscard]] std::size_t nearest_object(const Scene& scene, const Eigen::Vector3d& point_world);

/// handles: in the camera's frame, best first. category: of the frame, for tables.
[[nodiscard]] JudgedScene judge_scene(const TrueFrame& truth, const std::pmr::vector<Handle>& handles,
                                      const SolidJudge& judge, const std::string& category);

/// Every handle that does not hold: frame, rank, score, pose in the world and why.
[[nodiscard]] Table failed_handle_table(const std::vector<JudgedScene>& scenes);

/// Every object that the gripper can hold and no valid handle holds, with a pose that does.
[[nodiscard]] Table missed_object_table(const std::vector<JudgedScene>& scenes);

/// Recall and precision for each kind of object.
[[nodiscard]] Table kind_table(const std::vector<JudgedScene>& scenes);

/// How many of the handles that hold still do so in at least 10 of 12 disturbances.
[[nodiscard]] Table scene_steadiness_table(const std::vector<JudgedScene>& scenes);

/// The frames with most failed handles and missed objects, worst first.
[[nodiscard]] Table worst_scene_table(const std::vector<JudgedScene>& scenes, std::size_t rows);

}  // namespace graspd

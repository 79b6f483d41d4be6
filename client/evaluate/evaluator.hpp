// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Judges the handles of several runs frame by frame.
#pragma once
#include <map>
#include <memory_resource>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "client/evaluate/handle_file.hpp"
#include "client/evaluate/label_judge.hpp"
#include "client/evaluate/labelled_frames.hpp"
#include "client/evaluate/runs.hpp"
#include "client/evaluate/tables.hpp"

namespace graspd {

/// Handles from the frame's log where it has some, else from detection here.
struct LoggedOrDetected {
  DetectionRun run;
};

/// Where the handles of a run come from; a file's are best first in each frame.
using HandleSource = std::variant<DetectionRun, LoggedOrDetected, HandleFile>;

struct EvaluatedRun {
  std::string name;
  Gripper gripper;
  HandleSource handles;
};

struct EvaluatorConfig {
  /// Takes handles of files and logs back into the cloud's frame.
  Eigen::Isometry3f T_cloud_handles = Eigen::Isometry3f::Identity();
  /// Objects that count for recall, by frame; none given: every object with at least min_points.
  std::optional<std::map<std::string, std::set<int>>> graspable;
  int min_points = 100;
  std::map<std::string, std::string> category_of_frame;
  std::vector<std::pair<std::string, std::string>> category_patterns;  ///< name and glob; the first one wins
  bool disturb = false;
};

/// How steady the handles of a run are.
struct Steadiness {
  static constexpr int kWanted = 10;  ///< of the disturbances

  int handles = 0;
  int both_hidden = 0;  ///< both fingers more than half in space that the sensor has not seen
  int valid = 0;
  int steady = 0;  ///< of the valid ones
};

class Evaluator {
 public:
  Evaluator(std::vector<EvaluatedRun> runs, EvaluatorConfig config);

  /// Throws std::runtime_error for a frame without labels. Uses the calling thread's oneTBB arena.
  void add(const LabelledFrame& frame);

  [[nodiscard]] const std::vector<NamedRun>& runs() const { return judged_; }
  [[nodiscard]] const std::vector<Steadiness>& steadiness() const { return steadiness_; }  ///< of each run
  /// Frames that the list of graspable objects does not name: none of their objects counts.
  [[nodiscard]] int frames_without_graspable() const { return frames_without_graspable_; }
  /// Frames that a file of handles does not name, over all files: they count as frames without handles.
  [[nodiscard]] int frames_without_handles() const { return frames_without_handles_; }

 private:
  [[nodiscard]] std::pmr::vector<Handle> handles_of(const EvaluatedRun& run, const LabelledFrame& frame);
  [[nodiscard]] std::vector<int> counted_objects(const LabelScene& scene, const std::string& frame);
  [[nodiscard]] std::string category_of(const std::string& frame) const;
  [[nodiscard]] std::pmr::vector<Handle> in_cloud_frame(std::pmr::vector<Handle> handles) const;
  void measure_steadiness(const LabelScene& scene, const Gripper& gripper,
                          const std::pmr::vector<Handle>& handles, const std::vector<Verdict>& verdicts,
                          Steadiness& steadiness) const;

  std::vector<EvaluatedRun> settings_;
  EvaluatorConfig config_;
  std::vector<NamedRun> judged_;
  std::vector<Steadiness> steadiness_;
  int frames_without_graspable_ = 0;
  int frames_without_handles_ = 0;
};

/// One row a run.
[[nodiscard]] Table steadiness_table(const Evaluator& evaluator);

/// Objects that one of two runs over the same frames finds alone, and valid handles that have no valid
/// neighbour (within 10 mm and 15 degrees) in the other.
[[nodiscard]] Table difference_table(const NamedRun& a, const NamedRun& b);

}  // namespace graspd

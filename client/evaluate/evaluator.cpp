// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/evaluator.hpp"

#include <fnmatch.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "client/evaluate/disturbance.hpp"
#include "service/pipeline/detect_handles.hpp"

namespace graspd {
namespace {

std::pmr::vector<Handle> detected(const DetectionRun& run, const PointCloud& cloud) {
  return detect_handles(changed(cloud, run.change), run.gripper, run.detect).handles;
}

std::vector<Verdict> judge_all(const LabelScene& scene, const Gripper& gripper,
                               const std::pmr::vector<Handle>& handles) {
  std::vector<Verdict> verdicts(handles.size());
  tbb::parallel_for(std::size_t{0}, handles.size(),
                    [&](std::size_t i) { verdicts[i] = judge(scene, gripper, handles[i]); });
  return verdicts;
}

}  // namespace

Evaluator::Evaluator(std::vector<EvaluatedRun> runs, EvaluatorConfig config)
    : settings_(std::move(runs)), config_(std::move(config)), steadiness_(settings_.size()) {
  for (const EvaluatedRun& run : settings_) judged_.push_back({run.name, {}});
}

std::pmr::vector<Handle> Evaluator::in_cloud_frame(std::pmr::vector<Handle> handles) const {
  for (Handle& handle : handles) handle = transformed(handle, config_.T_cloud_handles);
  return handles;
}

std::pmr::vector<Handle> Evaluator::handles_of(const EvaluatedRun& run, const LabelledFrame& frame) {
  if (const auto* detection = std::get_if<DetectionRun>(&run.handles))
    return detected(*detection, frame.cloud.cloud);
  if (const auto* either = std::get_if<LoggedOrDetected>(&run.handles)) {
    if (frame.logged_handles) return in_cloud_frame(*frame.logged_handles);
    return detected(either->run, frame.cloud.cloud);
  }
  const auto& file = std::get<HandleFile>(run.handles);
  const auto* handles = frame.seq ? file.find(*frame.seq) : file.find(frame.name);
  if (handles == nullptr) ++frames_without_handles_;
  return handles == nullptr ? std::pmr::vector<Handle>() : in_cloud_frame(*handles);
}

std::vector<int> Evaluator::counted_objects(const LabelScene& scene, const std::string& frame) {
  std::vector<int> objects;
  if (config_.graspable) {
    const auto found = config_.graspable->find(frame);
    if (found == config_.graspable->end())
      ++frames_without_graspable_;
    else
      objects.assign(found->second.begin(), found->second.end());
    return objects;
  }
  for (const LabelScene::Object& object : scene.objects())
    if (object.points >= config_.min_points) objects.push_back(object.id);
  return objects;
}

std::string Evaluator::category_of(const std::string& frame) const {
  const auto named = config_.category_of_frame.find(frame);
  if (named != config_.category_of_frame.end()) return named->second;
  for (const auto& [name, pattern] : config_.category_patterns)
    if (fnmatch(pattern.c_str(), frame.c_str(), 0) == 0) return name;
  return {};
}

void Evaluator::measure_steadiness(const LabelScene& scene, const Gripper& gripper,
                                   const std::pmr::vector<Handle>& handles,
                                   const std::vector<Verdict>& verdicts, Steadiness& steadiness) const {
  std::vector<int> valid(handles.size());
  tbb::parallel_for(std::size_t{0}, handles.size(), [&](std::size_t i) {
    if (verdicts[i].valid()) valid[i] = valid_disturbances(scene, gripper, handles[i], Steadiness::kWanted);
  });
  for (std::size_t i = 0; i < handles.size(); ++i) {
    ++steadiness.handles;
    steadiness.both_hidden += verdicts[i].both_fingers_hidden() ? 1 : 0;
    steadiness.valid += verdicts[i].valid() ? 1 : 0;
    steadiness.steady += valid[i] >= Steadiness::kWanted ? 1 : 0;
  }
}

void Evaluator::add(const LabelledFrame& frame) {
  const LabelScene scene(frame.cloud);
  const std::vector<int> objects = counted_objects(scene, frame.name);
  for (std::size_t r = 0; r < settings_.size(); ++r) {
    const Gripper& gripper = settings_[r].gripper;
    const std::pmr::vector<Handle> handles = handles_of(settings_[r], frame);
    const std::vector<Verdict> verdicts = judge_all(scene, gripper, handles);
    JudgedFrame& judged = judged_[r].frames.emplace_back();
    judged.name = frame.name;
    judged.category = category_of(frame.name);
    judged.objects = objects;
    for (std::size_t i = 0; i < handles.size(); ++i)
      judged.handles.push_back(
          {handles[i], verdicts[i].object, verdicts[i].valid(), std::string(name(verdicts[i].failure))});
    if (config_.disturb) measure_steadiness(scene, gripper, handles, verdicts, steadiness_[r]);
  }
}

Table steadiness_table(const Evaluator& evaluator) {
  Table table{"disturbances",
              "Handles when the robot is a little off",
              {"run", "handles", "both fingers hidden", "valid", "still valid in 10 of 12"},
              {}};
  for (std::size_t r = 0; r < evaluator.runs().size(); ++r) {
    const Steadiness& s = evaluator.steadiness()[r];
    table.rows.push_back({evaluator.runs()[r].name, std::int64_t{s.handles},
                          Percentage{share(s.both_hidden, s.handles)}, std::int64_t{s.valid},
                          Percentage{share(s.steady, s.valid)}});
  }
  return table;
}

}  // namespace graspd

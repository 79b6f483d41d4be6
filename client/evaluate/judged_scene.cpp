// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/judged_scene.hpp"

#include <algorithm>
#include <limits>

namespace graspd {
namespace {

int label_of(const Scene& scene, std::size_t solid) {
  return solid == kNoSolid ? -1 : static_cast<int>(scene.solids[solid].label);
}

}  // namespace

std::size_t nearest_object(const Scene& scene, const Eigen::Vector3d& point) {
  std::size_t nearest = kNoSolid;
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < scene.solids.size(); ++i) {
    if (scene.solids[i].label < object_label(kFirstObject)) continue;
    const double distance = signed_distance(scene.solids[i], point);
    if (distance >= best) continue;
    best = distance;
    nearest = i;
  }
  return nearest;
}

TrueFrame true_frame(const SimulationConfig& config, std::int64_t seq) {
  Simulation simulation(config);
  TrueFrame truth;
  truth.seq = seq;
  truth.measured = simulation.frame(seq);
  truth.ideal = simulation.ideal();
  truth.scene = simulation.scene();
  truth.T_world_camera = simulation.T_world_camera(seq);
  return truth;
}

JudgedScene judge_scene(const TrueFrame& truth, const std::pmr::vector<Handle>& handles,
                        const SolidJudge& judge, const std::string& category) {
  const Scene& scene = judge.probe().scene();
  JudgedScene judged;
  judged.frame.name = std::to_string(truth.seq);
  judged.frame.category = category;
  for (GraspableSolid& found : graspable_solids(judge, truth.ideal, truth.T_world_camera)) {
    if (found.graspable) judged.frame.objects.push_back(static_cast<int>(found.label));
    const std::string kind = scene.solids[found.solid].kind;
    judged.objects.push_back({std::move(found), kind});
  }
  for (const Handle& handle : handles) {
    const Handle in_world = transformed(handle, truth.T_world_camera.cast<float>());
    SolidVerdict verdict = judge.judge(in_world);
    if (verdict.failure == SolidFailure::kFixed) {
      ++judged.wall_handles;
      continue;
    }
    // Some fail before the jaws close.
    if (verdict.solid == kNoSolid) verdict.solid = nearest_object(scene, in_world.position.cast<double>());
    judged.frame.handles.push_back({handle, label_of(scene, verdict.solid), verdict.holds(),
                                    verdict.holds() ? "" : std::string(name(verdict.failure))});
    const int undisturbed_in = verdict.holds() ? undisturbed(judge, in_world, verdict.solid) : 0;
    judged.handles.push_back({in_world, verdict, undisturbed_in, verdict.text(scene)});
  }
  return judged;
}

}  // namespace graspd

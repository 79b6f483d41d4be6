// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "client/common/text.hpp"
#include "client/evaluate/scene_runs.hpp"

namespace graspd {
namespace {

/// The first handle of each object, by the object's index in the scene.
std::map<std::size_t, Handle> best_handles(const TrueFrame& truth, const std::pmr::vector<Handle>& handles) {
  std::map<std::size_t, Handle> best;
  for (const Handle& handle : handles) {
    const Handle in_world = transformed(handle, truth.T_world_camera.cast<float>());
    best.emplace(nearest_object(truth.scene, in_world.position.cast<double>()), handle);
  }
  return best;
}

double median(const std::vector<PoseMove>& moves, double PoseMove::*member) {
  std::vector<double> values;
  for (const PoseMove& move : moves) values.push_back(move.*member);
  return percentile(std::move(values), 0.5);
}

std::vector<Cell> stability_row(const std::string& name, const ObjectStability& object, double frames) {
  return {name,
          static_cast<std::int64_t>(object.seed),
          static_cast<std::int64_t>(object.label),
          Percentage{object.frames_with_handle / frames},
          1e3 * median(object.moves, &PoseMove::distance_m),
          median(object.moves, &PoseMove::angle_deg)};
}

}  // namespace

PoseMove pose_move(const Handle& from, const Handle& to) {
  const Eigen::Matrix3d turn = (from.rotation.transpose() * to.rotation).cast<double>();
  // A turn R by an angle has trace 1 + 2 cos; half a turn about z swaps the signs of x and y.
  const double trace = std::max(turn.trace(), turn(2, 2) - turn(0, 0) - turn(1, 1));
  const double angle = std::acos(std::clamp(0.5 * (trace - 1), -1.0, 1.0));
  return {static_cast<double>((to.position - from.position).norm()), angle * 180 / std::numbers::pi};
}

std::vector<ObjectStability> pose_stability(SimulationConfig simulation, std::int64_t frames,
                                            const HandlesOfFrame& handles) {
  simulation.new_scene_every = 0;
  simulation.orbit_rad_per_frame = 0;
  std::vector<ObjectStability> objects;
  std::map<std::size_t, Handle> first;
  std::map<std::size_t, std::size_t> row;
  for (std::int64_t k = 0; k < frames; ++k) {
    const TrueFrame truth = true_frame(simulation, k);
    const auto best = best_handles(truth, handles(truth).value_or(std::pmr::vector<Handle>()));
    if (k == 0) {
      first = best;
      for (const auto& [solid, handle] : first) {
        row[solid] = objects.size();
        objects.push_back(
            {simulation.seed, truth.scene.solids[solid].label, truth.scene.solids[solid].kind, 0, {}});
      }
      continue;
    }
    for (const auto& [solid, handle] : best) {
      const auto known = first.find(solid);
      if (known == first.end()) continue;
      ObjectStability& object = objects[row[solid]];
      ++object.frames_with_handle;
      object.moves.push_back(pose_move(known->second, handle));
    }
  }
  return objects;
}

Table stability_table(const std::vector<ObjectStability>& objects, std::int64_t frames) {
  Table table{
      "stability",
      "Movement of the best handle of each object",
      {"object", "seed", "label", "frames with a handle", "median distance [mm]", "median angle [degrees]"},
      {}};
  ObjectStability all;
  for (const ObjectStability& object : objects) {
    table.rows.push_back(stability_row(object.kind, object, double(frames - 1)));
    all.frames_with_handle += object.frames_with_handle;
    all.moves.insert(all.moves.end(), object.moves.begin(), object.moves.end());
  }
  auto row = stability_row("all", all, double(frames - 1) * double(objects.size()));
  row[1] = row[2] = {};
  table.rows.push_back(std::move(row));
  return table;
}

}  // namespace graspd

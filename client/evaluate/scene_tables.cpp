// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <map>

#include "client/evaluate/evaluator.hpp"
#include "client/evaluate/judged_scene.hpp"

namespace graspd {
namespace {

using Count = std::int64_t;

void add_pose(std::vector<Cell>& row, const Handle& handle) {
  for (const float v : handle.position) row.emplace_back(double{v});
  const Eigen::Quaternionf q = quaternion(handle.rotation);
  for (const float v : {q.w(), q.x(), q.y(), q.z()}) row.emplace_back(double{v});
  row.emplace_back(double{handle.width_m});
}

/// Whether some handle of the frame holds the object.
bool is_held(const JudgedFrame& frame, int label) {
  return std::any_of(frame.handles.begin(), frame.handles.end(),
                     [&](const JudgedHandle& h) { return h.valid && h.object == label; });
}

int missed_objects(const JudgedFrame& frame) {
  return static_cast<int>(std::count_if(frame.objects.begin(), frame.objects.end(),
                                        [&](int label) { return !is_held(frame, label); }));
}

int failed_handles(const JudgedFrame& frame) {
  return static_cast<int>(std::count_if(frame.handles.begin(), frame.handles.end(),
                                        [](const JudgedHandle& h) { return !h.valid; }));
}

struct KindCounts {
  Count seen = 0, graspable = 0, held = 0, handles = 0, valid_handles = 0;
};

Percentage share_of(Count part, Count whole) {
  return {share(static_cast<int>(part), static_cast<int>(whole))};
}

}  // namespace

Table failed_handle_table(const std::vector<JudgedScene>& scenes) {
  Table table{"failed",
              "Handles that do not hold",
              {"frame", "rank", "score", "object", "failure", "px", "py", "pz", "qw", "qx", "qy", "qz",
               "width", "explanation"},
              {}};
  for (const JudgedScene& scene : scenes) {
    for (std::size_t rank = 0; rank < scene.handles.size(); ++rank) {
      const JudgedHandle& judged = scene.frame.handles[rank];
      if (judged.valid) continue;
      const Handle& handle = scene.handles[rank].handle_world;
      std::vector<Cell> row{scene.frame.name, static_cast<Count>(rank), double{handle.score},
                            static_cast<Count>(judged.object), judged.failure};
      add_pose(row, handle);
      row.emplace_back(scene.handles[rank].explanation);
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

Table missed_object_table(const std::vector<JudgedScene>& scenes) {
  Table table{
      "missed",
      "Objects that can be held and are not found",
      {"frame", "object", "kind", "pixels", "handles", "px", "py", "pz", "qw", "qx", "qy", "qz", "width"},
      {}};
  for (const JudgedScene& scene : scenes) {
    for (const SceneObject& object : scene.objects) {
      const int label = static_cast<int>(object.found.label);
      if (!object.found.graspable || is_held(scene.frame, label)) continue;
      const auto tried = std::count_if(scene.frame.handles.begin(), scene.frame.handles.end(),
                                       [&](const JudgedHandle& h) { return h.object == label; });
      std::vector<Cell> row{scene.frame.name, static_cast<Count>(label), object.kind,
                            static_cast<Count>(object.found.pixels), static_cast<Count>(tried)};
      add_pose(row, object.found.poses.front());
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

Table kind_table(const std::vector<JudgedScene>& scenes) {
  std::map<std::string, KindCounts> kinds;
  Count wall_handles = 0;
  for (const JudgedScene& scene : scenes) {
    wall_handles += scene.wall_handles;
    for (const SceneObject& object : scene.objects) {
      KindCounts& counts = kinds[object.kind];
      const int label = static_cast<int>(object.found.label);
      ++counts.seen;
      counts.graspable += object.found.graspable ? 1 : 0;
      counts.held += object.found.graspable && is_held(scene.frame, label) ? 1 : 0;
      for (const JudgedHandle& h : scene.frame.handles) {
        if (h.object != label) continue;
        ++counts.handles;
        counts.valid_handles += h.valid ? 1 : 0;
      }
    }
  }
  Table table{"kinds",
              "By kind of object",
              {"kind", "seen", "graspable", "found", "recall", "handles", "valid handles", "precision"},
              {}};
  for (const auto& [kind, c] : kinds)
    table.rows.push_back({kind, c.seen, c.graspable, c.held, share_of(c.held, c.graspable), c.handles,
                          c.valid_handles, share_of(c.valid_handles, c.handles)});
  if (wall_handles > 0)
    table.rows.push_back({"wall of the bin, not counted", {}, {}, {}, {}, wall_handles, {}, {}});
  return table;
}

Table scene_steadiness_table(const std::vector<JudgedScene>& scenes) {
  Count valid = 0, steady = 0;
  for (const JudgedScene& scene : scenes) {
    for (const SceneHandle& handle : scene.handles) {
      valid += handle.verdict.holds() ? 1 : 0;
      steady += handle.undisturbed >= Steadiness::kWanted ? 1 : 0;
    }
  }
  return {"disturbances",
          "Handles when the robot is a little off",
          {"valid", "still valid in 10 of 12"},
          {{valid, share_of(steady, valid)}}};
}

Table worst_scene_table(const std::vector<JudgedScene>& scenes, std::size_t rows) {
  std::vector<const JudgedFrame*> frames;
  for (const JudgedScene& scene : scenes) frames.push_back(&scene.frame);
  const auto badness = [](const JudgedFrame* frame) {
    return failed_handles(*frame) + missed_objects(*frame);
  };
  std::stable_sort(frames.begin(), frames.end(),
                   [&](const JudgedFrame* a, const JudgedFrame* b) { return badness(a) > badness(b); });
  frames.resize(std::min(rows, frames.size()));
  Table table{"worst", "Worst frames", {"frame", "graspable objects", "missed", "handles", "failed"}, {}};
  for (const JudgedFrame* frame : frames)
    table.rows.push_back(
        {frame->name, static_cast<Count>(frame->objects.size()), static_cast<Count>(missed_objects(*frame)),
         static_cast<Count>(frame->handles.size()), static_cast<Count>(failed_handles(*frame))});
  return table;
}

}  // namespace graspd

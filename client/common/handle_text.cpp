// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/common/handle_text.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <span>

#include "client/common/json_writer.hpp"
#include "client/common/text.hpp"

namespace graspd {
namespace {

void write_floats(JsonWriter& json, std::string_view name, std::span<const double> values) {
  json.key(name).begin_array();
  for (const double v : values) json.value_float(v);
  json.end_array();
}

void write_float(JsonWriter& json, std::string_view name, double value) {
  json.key(name).value_float(value);
}

void write_gripper(JsonWriter& json, const gripper_t& gripper) {
  json.key("gripper").begin_object();
  json.member("name", gripper.name);
  write_float(json, "aperture", gripper.aperture);
  write_float(json, "finger_width", gripper.finger_width);
  write_float(json, "finger_thickness", gripper.finger_thickness);
  write_float(json, "finger_length", gripper.finger_length);
  write_float(json, "grasp_depth", gripper.grasp_depth);
  write_float(json, "min_gap", gripper.min_gap);
  json.end_object();
}

void write_counts(JsonWriter& json, std::string_view name, std::span<const reason_count_t> counts) {
  json.key(name).begin_object();
  for (const reason_count_t& count : counts) json.member(count.reason, count.count);
  json.end_object();
}

void write_handle(JsonWriter& json, const handle_t& handle) {
  json.begin_object().member("id", handle.id).member("segment_id", handle.segment_id);
  write_floats(json, "position", handle.position);
  write_floats(json, "orientation", handle.orientation);
  write_floats(json, "rpy", handle.rpy);
  write_floats(json, "approach", handle.approach);
  write_floats(json, "closing_axis", handle.closing_axis);
  write_floats(json, "major_axis", handle.major_axis);
  write_float(json, "width", handle.width);
  write_floats(json, "gap", handle.gap);
  write_floats(json, "observed_free", handle.observed_free);
  json.member("num_points", handle.num_points);
  write_float(json, "score", handle.score);
  json.end_object();
}

double degrees(double angle_rad) {
  return angle_rad * 180 / std::numbers::pi;
}

}  // namespace

std::string_view status_name(std::int8_t status) {
  constexpr std::array<std::string_view, 8> kNames{
      "OK",         "EMPTY_CLOUD", "NO_FINITE_POINTS", "NOTHING_IN_WORKSPACE",
      "NO_HANDLES", "REFUSED",     "OVERLOADED",       "FAILED"};
  const auto index = static_cast<std::size_t>(static_cast<std::uint8_t>(status));
  return index < kNames.size() ? kNames[index] : "UNKNOWN";
}

std::string handle_list_line(const handle_list_t& list) {
  std::string line = plain_line(list.source_channel) + "  frame " + plain_line(list.frame_name) +
                     printed("  seq %lld  ", static_cast<long long>(list.seq)) +
                     std::string(status_name(list.status));
  if (list.status != handle_list_t::OK && !list.status_text.empty())
    line += " (" + plain_line(list.status_text) + ")";
  if (list.degraded != 0) line += printed("  degraded to %.1f mm voxels", 1e3 * list.voxel_size);
  return line + printed("  %zu handles  %d of %d points  %d segments  %d candidates  %.1f ms",
                        list.handles.size(), list.points_used, list.points_in, list.num_segments,
                        list.num_candidates, 1e3 * list.latency);
}

std::string handle_table(const handle_list_t& list, std::size_t max_rows) {
  if (list.handles.empty()) return {};
  TextTable table({"rank", "x [m]", "y [m]", "z [m]", "roll", "pitch", "yaw [deg]", "width [mm]", "gaps [mm]",
                   "seen", "points", "score"});
  const std::size_t n = std::min(max_rows, list.handles.size());
  for (std::size_t i = 0; i < n; ++i) {
    const handle_t& h = list.handles[i];
    table.add({printed("%d", h.id), printed("%.3f", h.position[0]), printed("%.3f", h.position[1]),
               printed("%.3f", h.position[2]), printed("%.0f", degrees(h.rpy[0])),
               printed("%.0f", degrees(h.rpy[1])), printed("%.0f", degrees(h.rpy[2])),
               printed("%.0f", 1e3 * h.width), printed("%.0f / %.0f", 1e3 * h.gap[0], 1e3 * h.gap[1]),
               printed("%.0f / %.0f %%", 100 * h.observed_free[0], 100 * h.observed_free[1]),
               printed("%d", h.num_points), printed("%.3f", h.score)});
  }
  std::string text = table.str();
  if (n < list.handles.size()) text += printed("... and %zu more\n", list.handles.size() - n);
  return text;
}

void write_handle_list(JsonWriter& json, const handle_list_t& list) {
  json.member("utime", list.utime).member("seq", list.seq);
  json.member("source_channel", list.source_channel).member("frame_name", list.frame_name);
  write_gripper(json, list.gripper);
  json.member("status", status_name(list.status)).member("status_text", list.status_text);
  json.member("config_revision", list.config_revision).key("voxel_size").value_float(list.voxel_size);
  json.member("degraded", list.degraded);
  json.member("points_in", list.points_in).member("points_used", list.points_used);
  json.member("num_segments", list.num_segments).member("num_candidates", list.num_candidates);
  write_counts(json, "candidate_failures", list.candidate_failures);
  write_counts(json, "segment_failures", list.segment_failures);
  json.key("stages_ms").begin_object();
  for (const stage_time_t& stage : list.stages) json.member(stage.stage, stage.milliseconds);
  json.end_object().member("latency", list.latency);
  json.key("handles").begin_array();
  for (const handle_t& handle : list.handles) write_handle(json, handle);
  json.end_array();
}

std::string handle_list_json(const handle_list_t& list) {
  JsonWriter json;
  json.begin_object();
  write_handle_list(json, list);
  json.end_object();
  return json.str();
}

}  // namespace graspd

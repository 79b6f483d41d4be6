// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/table/handle_tables.hpp"

#include <array>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "client/common/handle_text.hpp"
#include "client/log/event_log_reader.hpp"
#include "client/table/table_columns.hpp"
#include "service/transport/handle_list_codec.hpp"

namespace graspd {
namespace {

void add_all(ParquetFile& table, std::span<const double> values) {
  for (const double value : values) table.add(value);
}

/// "too_wide 98, no_gap 14".
std::string text_of(const std::vector<reason_count_t>& reasons) {
  std::string text;
  for (const reason_count_t& reason : reasons)
    text += (text.empty() ? "" : ", ") + reason.reason + ' ' + std::to_string(reason.count);
  return text;
}

}  // namespace

std::filesystem::path frames_table_path(const std::filesystem::path& file) {
  std::filesystem::path path = file;
  path.replace_extension();
  return path.string() + ".frames.parquet";
}

HandleTables::HandleTables(const std::filesystem::path& file)
    : handles_(file, handle_columns()), frames_(frames_table_path(file), frame_columns()) {}

void HandleTables::add(std::int64_t recv_utime, std::string_view channel, const handle_list_t& list) {
  const std::int64_t frame = frames_.rows();
  for (const handle_t& h : list.handles) {
    handles_.add(frame).add(list.utime).add(list.seq).add(std::string_view(list.source_channel));
    handles_.add(std::int64_t{h.id}).add(std::int64_t{h.segment_id});
    for (const std::span<const double> values :
         {std::span<const double>(h.position), std::span<const double>(h.orientation),
          std::span<const double>(h.rpy), std::span<const double>(h.approach),
          std::span<const double>(h.closing_axis), std::span<const double>(h.major_axis),
          std::span<const double>(&h.width, 1), std::span<const double>(h.gap),
          std::span<const double>(h.observed_free)})
      add_all(handles_, values);
    handles_.add(std::int64_t{h.num_points}).add(h.score);
    handles_.end_row();
  }
  double work_ms = 0;
  for (const stage_time_t& stage : list.stages) work_ms += stage.milliseconds;
  frames_.add(frame).add(recv_utime).add(list.utime).add(list.seq);
  frames_.add(std::string_view(list.source_channel)).add(channel).add(std::string_view(list.frame_name));
  const gripper_t& gripper = list.gripper;
  frames_.add(std::string_view(gripper.name));
  add_all(frames_, std::array{gripper.aperture, gripper.finger_width, gripper.finger_thickness,
                              gripper.finger_length, gripper.grasp_depth, gripper.min_gap});
  frames_.add(status_name(list.status));
  frames_.add(std::string_view(list.status_text)).add(list.config_revision).add(list.voxel_size);
  for (const std::int32_t count : {std::int32_t{list.degraded}, list.points_in, list.points_used,
                                   list.num_segments, list.num_candidates, list.num_handles})
    frames_.add(std::int64_t{count});
  frames_.add(list.handles.empty() ? 0.0 : list.handles.front().score).add(list.latency).add(work_ms);
  frames_.add(std::string_view(text_of(list.candidate_failures)));
  frames_.add(std::string_view(text_of(list.segment_failures)));
  frames_.end_row();
}

void HandleTables::finish() {
  handles_.finish();
  frames_.finish();
}

std::int64_t write_tables(const std::filesystem::path& log, const std::filesystem::path& file) {
  EventLogReader reader(log);
  HandleTables tables(file);
  LoggedEvent event;
  while (reader.next(event))
    if (const auto list = decode_handle_list(event.bytes)) tables.add(event.recv_utime, event.channel, *list);
  tables.finish();
  return tables.frames();
}

}  // namespace graspd

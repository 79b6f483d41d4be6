// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/table/handle_tables_reader.hpp"

#include <span>
#include <stdexcept>
#include <string>

#include "client/common/handle_text.hpp"
#include "client/table/handle_tables.hpp"
#include "client/table/table_columns.hpp"

namespace graspd {
namespace {

/// The cells of the row that a reader is at, one after the other.
class Row {
 public:
  explicit Row(const ParquetReader& table) : table_(table) {}

  std::int64_t integer() { return table_.integer(next_++); }
  std::int32_t int32() { return static_cast<std::int32_t>(integer()); }
  double number() { return table_.number(next_++); }
  std::string text() { return std::string(table_.text(next_++)); }
  void numbers(std::span<double> values) {
    for (double& value : values) value = number();
  }
  void pass_over() { ++next_; }

 private:
  const ParquetReader& table_;
  std::size_t next_ = 0;
};

/// What numbers of a handle are in a table, in the order of its columns.
std::vector<std::span<double>> numbers_of(handle_t& h) {
  return {h.position,   h.orientation, h.rpy, h.approach,     h.closing_axis,
          h.major_axis, {&h.width, 1}, h.gap, h.observed_free};
}

std::int8_t status_of(std::string_view name) {
  for (std::int8_t status = 0; status <= handle_list_t::FAILED; ++status)
    if (status_name(status) == name) return status;
  return -1;
}

std::size_t column_of(std::string_view name) {
  const std::vector<Column> columns = frame_columns();
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i].name == name) return i;
  throw std::logic_error("no such column");
}

}  // namespace

HandleTablesReader::HandleTablesReader(const std::filesystem::path& file)
    : file_(file), handles_(file, handle_columns()), frames_(frames_table_path(file), frame_columns()) {
  const std::size_t column = column_of("num_handles");
  first_handles_.push_back(0);
  for (std::int64_t frame = 0; frame < frames_.rows(); ++frame) {
    frames_.go_to(frame);
    const std::int64_t count = frames_.integer(column);
    if (count < 0 || count > handles_.rows() - first_handles_.back())
      throw std::runtime_error(file_.string() + ": the tables do not belong together");
    first_handles_.push_back(first_handles_.back() + count);
  }
  if (first_handles_.back() != handles_.rows())
    throw std::runtime_error(file_.string() + ": the tables do not belong together");
}

handle_t HandleTablesReader::handle(std::int64_t row, std::int64_t frame) {
  handles_.go_to(row);
  Row cells(handles_);
  if (cells.integer() != frame)
    throw std::runtime_error(file_.string() + ": the tables do not belong together");
  for (int i = 0; i < 3; ++i) cells.pass_over();  // utime, seq, source_channel: the frame's
  handle_t h{};
  h.id = cells.int32();
  h.segment_id = cells.int32();
  for (const std::span<double> values : numbers_of(h)) cells.numbers(values);
  h.num_points = cells.int32();
  h.score = cells.number();
  return h;
}

handle_list_t HandleTablesReader::list(std::int64_t frame) {
  frames_.go_to(frame);
  Row cells(frames_);
  handle_list_t list{};
  cells.pass_over();  // its number
  cells.pass_over();  // recv_utime
  list.utime = cells.integer();
  list.seq = cells.integer();
  list.source_channel = cells.text();
  cells.pass_over();  // handles_channel
  list.frame_name = cells.text();
  gripper_t& g = list.gripper;
  g.name = cells.text();
  for (double* length :
       {&g.aperture, &g.finger_width, &g.finger_thickness, &g.finger_length, &g.grasp_depth, &g.min_gap})
    *length = cells.number();
  list.status = status_of(cells.text());
  list.status_text = cells.text();
  list.config_revision = cells.integer();
  list.voxel_size = cells.number();
  list.degraded = static_cast<std::int8_t>(cells.integer());
  for (std::int32_t* count :
       {&list.points_in, &list.points_used, &list.num_segments, &list.num_candidates, &list.num_handles})
    *count = cells.int32();
  cells.pass_over();  // best_score
  list.latency = cells.number();
  stage_time_t work{};
  work.milliseconds = cells.number();
  list.stages.push_back(work);
  list.num_stages = 1;
  const auto begin = first_handles_.at(static_cast<std::size_t>(frame));
  for (std::int32_t i = 0; i < list.num_handles; ++i) list.handles.push_back(handle(begin + i, frame));
  return list;
}

void round_as_in_tables(handle_list_t& list) {
  for (handle_t& h : list.handles) {
    for (const std::span<double> values : numbers_of(h))
      for (double& value : values) value = double{static_cast<float>(value)};
    h.score = double{static_cast<float>(h.score)};
  }
}

}  // namespace graspd

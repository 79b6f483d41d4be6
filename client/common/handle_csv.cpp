// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/common/handle_csv.hpp"

#include "client/common/handle_text.hpp"
#include "client/common/text.hpp"

namespace graspd {
namespace {

/// Members of handle_t hold floats: nine digits give each back exactly.
std::string number(double value) {
  return printed(",%.9g", value);
}

std::string row_start(const handle_list_t& list) {
  return csv_cell(list.frame_name) +
         printed(",%lld,%lld,", static_cast<long long>(list.seq), static_cast<long long>(list.utime)) +
         csv_cell(list.source_channel);
}

}  // namespace

std::string csv_cell(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::string handle_csv_header() {
  return "frame,seq,utime,channel,id,segment,px,py,pz,qw,qx,qy,qz,roll,pitch,yaw,width,gap_neg,gap_pos,"
         "observed_neg,observed_pos,points,score,status\n";
}

std::string handle_csv_rows(const handle_list_t& list, EmptyLists empty) {
  const std::string start = row_start(list);
  // Never empty: some readers lose an empty cell at the end of a line.
  const std::string end = ',' + std::string(status_name(list.status)) + '\n';
  std::string text;
  for (const handle_t& handle : list.handles) {
    text += start + printed(",%d,%d", handle.id, handle.segment_id);
    for (const double v : handle.position) text += number(v);
    for (const double v : handle.orientation) text += number(v);
    for (const double v : handle.rpy) text += number(v);
    text += number(handle.width);
    for (const double v : handle.gap) text += number(v);
    for (const double v : handle.observed_free) text += number(v);
    text += printed(",%d", handle.num_points) + number(handle.score) + end;
  }
  if (list.handles.empty() && empty == EmptyLists::kWriteRow)
    text = start + ",-1" + std::string(18, ',') + end;
  return text;
}

}  // namespace graspd

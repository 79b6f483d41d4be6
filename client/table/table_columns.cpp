// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/table/table_columns.hpp"

namespace graspd {

using enum ColumnType;

std::vector<Column> handle_columns() {
  std::vector<Column> columns{{"frame", kInt64},         {"utime", kInt64}, {"seq", kInt64},
                              {"source_channel", kText}, {"rank", kInt32},  {"segment", kInt32}};
  for (const char* name : {"px",         "py",        "pz",        "qw",        "qx",         "qy",
                           "qz",         "roll",      "pitch",     "yaw",       "approach_x", "approach_y",
                           "approach_z", "closing_x", "closing_y", "closing_z", "major_x",    "major_y",
                           "major_z",    "width",     "gap_minus", "gap_plus",  "free_minus", "free_plus"})
    columns.push_back({name, kFloat});
  columns.push_back({"num_points", kInt32});
  columns.push_back({"score", kFloat});
  return columns;
}

std::vector<Column> frame_columns() {
  return {{"frame", kInt64},
          {"recv_utime", kInt64},
          {"utime", kInt64},
          {"seq", kInt64},
          {"source_channel", kText},
          {"handles_channel", kText},
          {"frame_name", kText},
          {"gripper", kText},
          {"aperture", kDouble},
          {"finger_width", kDouble},
          {"finger_thickness", kDouble},
          {"finger_length", kDouble},
          {"grasp_depth", kDouble},
          {"min_gap", kDouble},
          {"status", kText},
          {"status_text", kText},
          {"config_revision", kInt64},
          {"voxel_size", kDouble},
          {"degraded", kInt32},
          {"points_in", kInt32},
          {"points_used", kInt32},
          {"num_segments", kInt32},
          {"num_candidates", kInt32},
          {"num_handles", kInt32},
          {"best_score", kDouble},
          {"latency", kDouble},
          {"work_ms", kDouble},
          {"candidate_failures", kText},
          {"segment_failures", kText}};
}

}  // namespace graspd

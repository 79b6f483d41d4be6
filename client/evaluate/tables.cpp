// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/tables.hpp"

#include <algorithm>

#include "client/common/text.hpp"

namespace graspd {
namespace {

using Row = std::vector<Cell>;

Cell number(std::optional<double> value) {
  if (!value) return {};
  return *value;
}

Cell count(int value) {
  return std::int64_t{value};
}

Cell object_cell(int object) {
  if (object < 0) return {};
  return count(object);
}

std::string object_name(const std::string& category, int object) {
  return (category.empty() ? "" : category + " ") + std::to_string(object);
}

const std::vector<std::string>& figure_columns() {
  static const std::vector<std::string> columns = [] {
    std::vector<std::string> c{"frames", "objects",   "found",         "recall",   "handles",
                               "valid",  "precision", "best of frame", "best five"};
    for (const int k : Figures::kRecallAt) c.push_back("recall@" + std::to_string(k));
    for (const char* name : {"handles/frame", "max/frame", "handles/object", "max/object"}) c.push_back(name);
    return c;
  }();
  return columns;
}

Row figure_row(const std::string& name, const Figures& f) {
  Row row{name,
          count(f.frames),
          count(f.objects),
          count(f.objects_found),
          Percentage{f.recall()},
          count(f.handles),
          count(f.valid_handles),
          Percentage{f.precision()},
          Percentage{f.best_of_frame()},
          Percentage{f.best_five()}};
  for (std::size_t i = 0; i < Figures::kRecallAt.size(); ++i) row.push_back(Percentage{f.recall_at(i)});
  row.insert(row.end(), {number(f.handles_per_frame()), count(f.max_handles_per_frame),
                         number(f.handles_per_object()), count(f.max_handles_per_object)});
  return row;
}

Table table_of_figures(const char* name, const char* title, const char* first_column) {
  Table table{name, title, {first_column}, {}};
  table.columns.insert(table.columns.end(), figure_columns().begin(), figure_columns().end());
  return table;
}

Row frame_row(const std::string& name, const Figures& f) {
  return {name,
          count(f.objects),
          count(f.handles),
          count(f.valid_handles),
          count(f.objects_found),
          Percentage{f.recall()},
          Percentage{f.precision()}};
}

}  // namespace

Table frame_table(std::span<const JudgedFrame> frames) {
  Table table{"frames",
              "Frames",
              {"frame", "objects", "handles", "valid", "objects found", "recall", "precision"},
              {}};
  for (const JudgedFrame& frame : frames) table.rows.push_back(frame_row(frame.name, figures(frame)));
  table.rows.push_back(frame_row("total", figures(frames)));
  return table;
}

Table object_table(std::span<const JudgedFrame> frames) {
  Table table{
      "objects", "Objects", {"object", "frames", "frames with a valid handle", "handles", "valid"}, {}};
  ObjectFigures total;
  for (const ObjectFigures& f : figures_by_object(frames)) {
    table.rows.push_back({object_name(f.category, f.object), count(f.frames),
                          Percentage{share(f.frames_found, f.frames)}, count(f.handles),
                          count(f.valid_handles)});
    total.frames += f.frames;
    total.frames_found += f.frames_found;
    total.handles += f.handles;
    total.valid_handles += f.valid_handles;
  }
  table.rows.push_back({std::string("total"), count(total.frames),
                        Percentage{share(total.frames_found, total.frames)}, count(total.handles),
                        count(total.valid_handles)});
  return table;
}

Table frame_table_side_by_side(std::span<const NamedRun> runs) {
  Table table{"frames", "Frames", {"frame", "objects"}, {}};
  for (const NamedRun& run : runs)
    for (const char* column : {" handles", " found", " recall"}) table.columns.push_back(run.name + column);
  const std::size_t num_frames = runs.empty() ? 0 : runs.front().frames.size();
  const auto add = [&](const std::string& name, const std::vector<Figures>& of_runs) {
    Row row{name, of_runs.empty() ? Cell() : count(of_runs.front().objects)};
    for (const Figures& f : of_runs)
      row.insert(row.end(), {count(f.handles), count(f.objects_found), Percentage{f.recall()}});
    table.rows.push_back(row);
  };
  std::vector<Figures> of_runs(runs.size());
  for (std::size_t i = 0; i < num_frames; ++i) {
    for (std::size_t r = 0; r < runs.size(); ++r) of_runs[r] = figures(runs[r].frames[i]);
    add(runs.front().frames[i].name, of_runs);
  }
  for (std::size_t r = 0; r < runs.size(); ++r) of_runs[r] = figures(runs[r].frames);
  add("total", of_runs);
  return table;
}

Table object_table_side_by_side(std::span<const NamedRun> runs) {
  Table table{"objects", "Objects", {"object", "frames"}, {}};
  for (const NamedRun& run : runs) {
    table.columns.push_back(run.name + " frames with a valid handle");
    const Table one = object_table(run.frames);
    for (std::size_t i = 0; i < one.rows.size(); ++i) {
      if (table.rows.size() == i) table.rows.push_back({one.rows[i][0], one.rows[i][1]});
      table.rows[i].push_back(one.rows[i][2]);
    }
  }
  return table;
}

Table figures_table(std::span<const NamedRun> runs) {
  Table table = table_of_figures("figures", "Figures", "run");
  for (const NamedRun& run : runs) table.rows.push_back(figure_row(run.name, figures(run.frames)));
  return table;
}

Table category_table(std::span<const JudgedFrame> frames) {
  Table table = table_of_figures("categories", "Categories", "category");
  for (const CategoryFigures& c : figures_by_category(frames))
    table.rows.push_back(figure_row(c.category, c.figures));
  table.rows.push_back(figure_row("all", figures(frames)));
  return table;
}

Table failure_table(std::span<const JudgedFrame> frames) {
  Table table{"failures", "Invalid handles by reason", {"failure", "handles", "share of all handles"}, {}};
  const int handles = figures(frames).handles;
  for (const FailureCount& c : failure_counts(frames))
    table.rows.push_back({c.failure, count(c.handles), Percentage{share(c.handles, handles)}});
  return table;
}

Table calibration_table(std::span<const JudgedFrame> frames) {
  Table table{"calibration",
              "Score against the share of valid handles",
              {"score", "handles", "mean score", "valid"},
              {}};
  const Calibration result = calibration(frames);
  int handles = 0;
  for (const ScoreBin& b : result.bins) {
    const auto mean = b.handles > 0 ? std::optional(b.mean_score) : std::nullopt;
    table.rows.push_back({printed("%.1f to %.1f", b.from, b.to), count(b.handles), number(mean),
                          Percentage{share(b.valid_handles, b.handles)}});
    handles += b.handles;
  }
  table.rows.push_back(
      {std::string("expected calibration error"), count(handles), number(result.expected_error), Cell()});
  return table;
}

Table invalid_handle_table(std::span<const JudgedFrame> frames) {
  Table table{"invalid",
              "Invalid handles",
              {"frame", "rank", "object", "px", "py", "pz", "width", "score", "failure"},
              {}};
  for (const JudgedFrame& frame : frames) {
    for (std::size_t rank = 0; rank < frame.handles.size(); ++rank) {
      const JudgedHandle& h = frame.handles[rank];
      if (h.valid) continue;
      const auto& p = h.handle.position;
      table.rows.push_back({frame.name, static_cast<std::int64_t>(rank), object_cell(h.object), double{p.x()},
                            double{p.y()}, double{p.z()}, double{h.handle.width_m}, double{h.handle.score},
                            h.failure});
    }
  }
  return table;
}

}  // namespace graspd

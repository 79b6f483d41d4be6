// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// graspd-evaluate: recall and precision of handles against labelled frames, or the solids of simulated
// scenes.
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "client/common/program.hpp"
#include "client/common/stop_flag.hpp"
#include "client/detect/detect_options.hpp"
#include "client/evaluate/evaluator.hpp"
#include "client/evaluate/graspable_search.hpp"
#include "client/evaluate/simulate_mode.hpp"
#include "service/config/config_error.hpp"

namespace graspd {
namespace {

struct Options {
  std::vector<std::string> frames;
  DetectOptions detect;
  std::string handles;
  std::vector<std::string> compare;
  bool ignore_logged = false;
  std::string graspable;
  bool find_graspable = false;
  int min_points = 100;
  std::string categories;
  std::vector<std::string> category_patterns;
  std::vector<std::string> variants;
  double voxel_mm = 0;
  bool half = false;
  bool unorganized = false;
  bool calibration = false;
  bool disturb = false;
  bool explain = false;
  bool summary = false;
  SimulateOptions simulate;
  TableFormat format = TableFormat::kMarkdown;
};

void add_handle_options(CLI::App& app, Options& o) {
  auto* handles = app.add_option("--handles", o.handles,
                                 "grade the handles in this CSV file of graspd-detect or graspd-listen");
  auto* compare = app.add_option("--compare", o.compare, "grade two such files and show where they differ")
                      ->expected(2)
                      ->allow_extra_args(false)
                      ->excludes(handles);
  app.add_flag("--detect", o.ignore_logged, "logs: detect here, also where the log has handles")
      ->excludes(handles)
      ->excludes(compare);
  std::vector<CLI::Option*> detection;
  detection.push_back(
      app.add_option("--variants", o.variants,
                     "detect also with other settings: thresholds, paper, voxels, clouds, "
                     "grippers (several: with commas)")
          ->delimiter(',')
          ->allow_extra_args(false)
          ->check(CLI::IsMember(std::vector<std::string>(kVariantGroups.begin(), kVariantGroups.end()))));
  detection.push_back(app.add_option("--voxel", o.voxel_mm, "detect with voxels of this size [mm]")
                          ->check(CLI::Range(0.5, 100.0)));
  detection.push_back(app.add_flag("--half", o.half, "detect in every second row and column"));
  detection.push_back(
      app.add_flag("--unorganized", o.unorganized, "detect in the points without their order"));
  for (CLI::Option* option : detection) option->excludes(handles)->excludes(compare);
}

void add_options(CLI::App& app, Options& o) {
  add_version(app);
  auto* frames =
      app.add_option("frames", o.frames, "labelled PCD or PLY files, folders of them, or LCM event logs");
  add_detect_options(app, o.detect);
  add_handle_options(app, o);
  auto* graspable = app.add_option("--graspable", o.graspable,
                                   "CSV file frame,object,poses: recall counts objects with 3 poses or more");
  app.add_flag("--find-graspable", o.find_graspable,
               "print such a file, from a search over poses with the labels, and do no more")
      ->excludes(graspable);
  app.add_option("--min-points", o.min_points, "smaller objects do not count, unless --graspable names them")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--categories", o.categories, "CSV file frame,category: figures for each category too");
  app.add_option("--category", o.category_patterns, "NAME=PATTERN: category of the frames whose names match")
      ->allow_extra_args(false);
  const std::map<std::string, TableFormat> formats{
      {"md", TableFormat::kMarkdown}, {"csv", TableFormat::kCsv}, {"json", TableFormat::kJson}};
  app.add_option("-f,--format", o.format, "md, csv or json")->transform(CLI::CheckedTransformer(formats));
  app.add_flag("--calibration", o.calibration, "score against the share of valid handles");
  app.add_flag("--disturb", o.disturb, "how many handles hold when the robot is 3 mm or 5 degrees off");
  app.add_flag("--explain", o.explain, "every invalid handle with its reason");
  app.add_flag("--summary", o.summary, "no tables of single frames and objects");
  add_simulate_options(app, o.simulate)->excludes(frames)->excludes(graspable);
}

EvaluatorConfig evaluator_config(const Options& o, const SourceConfig& source) {
  EvaluatorConfig config;
  config.T_cloud_handles = source.sensor_pose.T_target_cloud().inverse();
  config.min_points = o.min_points;
  config.disturb = o.disturb;
  if (!o.graspable.empty()) config.graspable = read_graspable_file(o.graspable);
  if (!o.categories.empty()) config.category_of_frame = read_category_file(o.categories);
  for (const std::string& text : o.category_patterns) {
    const auto at = text.find('=');
    if (at == text.npos || at == 0) throw ConfigError("--category: no NAME=PATTERN (got " + text + ")");
    config.category_patterns.emplace_back(text.substr(0, at), text.substr(at + 1));
  }
  return config;
}

EvaluatedRun file_run(const std::string& path, const Gripper& gripper) {
  return {std::filesystem::path(path).filename().string(), gripper, read_handle_file(path)};
}

std::vector<EvaluatedRun> evaluated_runs(const Options& o, const SourceConfig& source) {
  const Gripper& gripper = source.gripper.gripper;
  if (!o.handles.empty()) return {file_run(o.handles, gripper)};
  if (!o.compare.empty()) {
    std::vector<EvaluatedRun> both{file_run(o.compare[0], gripper), file_run(o.compare[1], gripper)};
    if (both[0].name == both[1].name) {
      both[0].name = o.compare[0];
      both[1].name = o.compare[1];
    }
    return both;
  }
  DetectionRun base{"graspd", gripper, source.detect, {o.half, o.unorganized}};
  if (o.voxel_mm > 0) set_voxel(base.detect, static_cast<float>(1e-3 * o.voxel_mm));
  if (const auto problem = base.detect.validate())
    throw ConfigError("--voxel: " + problem->key + ": " + problem->reason);
  std::vector<EvaluatedRun> runs;
  if (o.ignore_logged)
    runs.push_back({base.name, gripper, base});
  else
    runs.push_back({base.name, gripper, LoggedOrDetected{base}});
  for (const std::string& group : o.variants)
    for (const DetectionRun& run : variants(base, group)) runs.push_back({run.name, run.gripper, run});
  return runs;
}

std::vector<Table> tables_of(const Options& o, const Evaluator& evaluator) {
  const auto& runs = evaluator.runs();
  const auto& frames = runs.front().frames;
  std::vector<Table> tables;
  if (!o.summary && o.compare.empty()) tables = {frame_table(frames), object_table(frames)};
  if (!o.summary && !o.compare.empty())
    tables = {frame_table_side_by_side(runs), object_table_side_by_side(runs)};
  if (!figures_by_category(frames).empty()) tables.push_back(category_table(frames));
  tables.push_back(figures_table(runs));
  tables.push_back(failure_table(frames));
  if (o.disturb) tables.push_back(steadiness_table(evaluator));
  if (o.calibration) tables.push_back(calibration_table(frames));
  if (!o.compare.empty()) tables.push_back(difference_table(runs[0], runs[1]));
  if (o.explain) tables.push_back(invalid_handle_table(frames));
  return tables;
}

void show_progress(std::size_t done) {
  if (isatty(STDERR_FILENO) != 0 && isatty(STDOUT_FILENO) == 0) std::fprintf(stderr, "\r%zu frames", done);
}

/// Calls use for every frame; those that cannot be used cost a line and the good exit code.
int visit_frames(const CLI::App& app, const Options& o,
                 const std::function<void(const LabelledFrame&)>& use) {
  int result = kExitOk;
  std::size_t done = 0;
  const auto problem = [&](const std::string& line) {
    say(app, line);
    result = kExitFailed;
  };
  const auto visit = [&](const LabelledFrame& frame) {
    try {
      use(frame);
      show_progress(++done);
    } catch (const std::runtime_error& error) {
      problem(frame.name + ": " + error.what());
    }
    return !stop_requested();
  };
  for_each_frame(o.frames, visit, problem);
  if (done == 0) throw std::runtime_error("no labelled frame to evaluate");
  return result;
}

int print_graspable(const CLI::App& app, const Options& o, const Gripper& gripper) {
  write_output(graspable_csv_header());
  return visit_frames(app, o, [&](const LabelledFrame& frame) {
    const LabelScene scene(frame.cloud);
    write_output(graspable_csv_rows(frame.name, find_graspable(scene, gripper, o.min_points)));
  });
}

int evaluate_scenes(const Options& o, const SourceConfig& source) {
  tbb::task_arena arena(thread_count(o.detect));
  const Eigen::Isometry3f T_cloud_handles = source.sensor_pose.T_target_cloud().inverse();
  const auto runs = evaluated_runs(o, source);
  const auto tables = arena.execute([&] {
    return simulate_tables(o.simulate, runs, T_cloud_handles, {o.calibration, o.disturb, o.explain});
  });
  write_output(write_tables(tables, o.format));
  return kExitOk;
}

int evaluate(const CLI::App& app, const Options& o) {
  const SourceConfig source = source_config(o.detect);
  const int threads = thread_count(o.detect);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  if (o.simulate.given()) return evaluate_scenes(o, source);
  if (o.frames.empty()) throw ConfigError("frames: files, folders or logs are needed, or --simulate");
  if (o.find_graspable) return print_graspable(app, o, source.gripper.gripper);
  Evaluator evaluator(evaluated_runs(o, source), evaluator_config(o, source));
  tbb::task_arena arena(threads);
  const int result =
      visit_frames(app, o, [&](const LabelledFrame& frame) { arena.execute([&] { evaluator.add(frame); }); });
  if (evaluator.frames_without_graspable() > 0)
    say(app, o.graspable + ": does not name " + std::to_string(evaluator.frames_without_graspable()) +
                 " of the frames; their objects do not count");
  if (evaluator.frames_without_handles() > 0)
    say(app, "no handles in the file for " + std::to_string(evaluator.frames_without_handles()) + " frames");
  write_output(write_tables(tables_of(o, evaluator), o.format));
  return result;
}

}  // namespace
}  // namespace graspd

int main(int argc, char** argv) {
  using namespace graspd;
  CLI::App app("Recall and precision of handles against labelled frames or simulated scenes.",
               "graspd-evaluate");
  Options options;
  add_options(app, options);
  return run_program(app, argc, argv, [&] { return evaluate(app, options); });
}

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// graspd-detect: handles in cloud files, with the daemon's pipeline and configuration, without LCM.
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "client/common/answer_summary.hpp"
#include "client/common/cloud_file.hpp"
#include "client/common/cloud_list.hpp"
#include "client/common/handle_csv.hpp"
#include "client/common/handle_text.hpp"
#include "client/common/program.hpp"
#include "client/common/stop_flag.hpp"
#include "client/common/text.hpp"
#include "client/detect/detect_options.hpp"
#include "client/detect/explanation.hpp"
#include "client/detect/file_detection.hpp"

namespace graspd {
namespace {

struct Options {
  std::vector<std::string> inputs;
  DetectOptions detect;
  std::string format = "text";
  std::size_t max_rows = 10;
  bool empty_rows = false;
  bool explain = false;
  bool stats = false;
  bool summary = false;
};

void add_options(CLI::App& app, Options& o) {
  add_version(app);
  app.add_option("files", o.inputs, "PCD or PLY files, or folders of them")->required();
  add_detect_options(app, o.detect);
  app.add_option("-f,--format", o.format, "text, csv, or json (a line a file)")
      ->check(CLI::IsMember({"text", "csv", "json"}))
      ->capture_default_str();
  app.add_option("--rows", o.max_rows, "text: handles shown of a file")->capture_default_str();
  auto* empty_rows =
      app.add_flag("--empty-rows", o.empty_rows, "csv: a line with id -1 for files without handles");
  app.add_flag(
         "--explain", o.explain,
         "every segment, and why it has no handle; text: a table after the handles; csv: a table of its "
         "own in place of the handles (frame,seq,segment,object,px,py,pz,points,candidates,handles,"
         "listed,reason and a count for each check); json: a member, segments")
      ->excludes(empty_rows);
  app.add_flag("--stats", o.stats,
               "a line a file on standard error: counts, failures by reason, stage times");
  app.add_flag("--summary", o.summary,
               "at the end, on standard error: files by status, latency, handles a file");
}

void print(const Options& o, const FileDetection& detected) {
  const handle_list_t& list = detected.list;
  if (o.format == "csv") {
    write_output(o.explain ? explanation_csv_rows(detected)
                           : handle_csv_rows(list, o.empty_rows ? EmptyLists::kWriteRow : EmptyLists::kSkip));
  } else if (o.format == "json") {
    write_output((o.explain ? explanation_json(detected) : handle_list_json(list)) + '\n');
  } else {
    write_output(handle_list_line(list) + '\n' + handle_table(list, o.max_rows) +
                 (o.explain ? explanation_table(detected) : "") + '\n');
  }
}

void show_progress(std::size_t done, std::size_t all) {
  if (isatty(STDERR_FILENO) == 0 || isatty(STDOUT_FILENO) != 0) return;
  std::fprintf(stderr, "\r%zu of %zu%s", done, all, done == all ? "\n" : "");
}

int detect(const CLI::App& app, const Options& o) {
  const SourceConfig source = source_config(o.detect);
  const auto files = list_cloud_files(o.inputs);
  const int threads = thread_count(o.detect);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  AnswerSummary summary;
  int result = kExitOk;
  if (o.format == "csv") write_output(o.explain ? explanation_csv_header() : handle_csv_header());
  for (std::size_t i = 0; i < files.size() && !stop_requested(); ++i) {
    try {
      const PointCloud cloud = load_cloud(files[i]).cloud;
      const auto seq = static_cast<std::int64_t>(i);
      const FileDetection detected =
          arena.execute([&] { return detect_in_cloud(cloud, files[i].stem().string(), seq, source); });
      summary.add(detected.list);
      print(o, detected);
      if (o.stats) say_block(plain_line(detection_stats(detected.list)) + '\n');
    } catch (const CloudFileError& error) {
      // The other files may be good.
      say(app, error.what());
      result = kExitFailed;
    }
    show_progress(i + 1, files.size());
  }
  if (o.summary) say_block(summary.str());
  return result;
}

}  // namespace
}  // namespace graspd

int main(int argc, char** argv) {
  using namespace graspd;
  CLI::App app("Finds handles in cloud files, as the daemon would.", "graspd-detect");
  Options options;
  add_options(app, options);
  return run_program(app, argc, argv, [&] { return detect(app, options); });
}

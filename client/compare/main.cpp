// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// graspd-compare: what changed between two runs over the same logs.
#include <CLI/CLI.hpp>
#include <fstream>
#include <stdexcept>

#include "client/common/handle_csv.hpp"
#include "client/common/program.hpp"
#include "client/common/replace_file.hpp"
#include "client/common/text.hpp"
#include "client/compare/report.hpp"
#include "client/log/log_parts.hpp"

namespace graspd {
namespace {

struct Options {
  std::string before;
  std::string after;
  std::string output;
  std::vector<std::string> clouds;
  std::string config;
  std::string key_file;
  ComparisonOptions comparison;
  double max_worse = 1;
};

void add_options(CLI::App& app, Options& o) {
  add_version(app);
  app.add_option("before", o.before,
                 "first run: event log with its handle lists, or FILE.parquet of graspd-replay --table")
      ->required();
  app.add_option("after", o.after, "second run: likewise")->required();
  app.add_option("-o,--output", o.output,
                 "folder for report.md, report.html, frames.csv (a row a frame) and pictures");
  app.add_option("--clouds", o.clouds, "the logs that both runs were over, for pictures of the worst frames");
  app.add_option("--key", o.key_file, "opens signed clouds (default: authentication.key_file)");
  app.add_option("--config", o.config,
                 "the daemon's configuration, for where sensors are (default: its defaults)");
  app.add_option("--worst", o.comparison.num_worst, "frames listed and drawn, the worst first")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  app.add_option("--tolerance", o.comparison.tolerance, "net losses up to this are neither worse nor better")
      ->check(CLI::Range(0.0, 2.0))
      ->capture_default_str();
  app.add_option("--max-worse", o.max_worse, "fail when a larger share of the frames got worse")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
}

std::string csv_row(const FrameDifference& d) {
  return printed("%lld,", static_cast<long long>(d.frame)) + csv_cell(d.key.channel) +
         printed(",%lld,%lld,", static_cast<long long>(d.key.seq), static_cast<long long>(d.key.utime)) +
         d.status_before + ',' + d.status_after +
         printed(",%d,%d,%d,%d,%.6f,%.6f,%.6f\n", d.handles_before, d.handles_after, d.lost, d.gained,
                 d.best_before, d.best_after, d.net_loss());
}

int compare(const CLI::App& app, const Options& o) {
  const std::filesystem::path folder = o.output;
  std::ofstream csv;
  if (!o.output.empty()) {
    std::filesystem::create_directories(folder);
    csv.open(folder / "frames.csv");
    csv << "frame,channel,seq,utime,status_before,status_after,handles_before,handles_after,lost,gained,"
           "best_before,best_after,net_loss\n";
  }
  const RunComparison comparison =
      compare_runs(o.before, o.after, o.comparison, [&](const FrameDifference& d) {
        if (csv.is_open()) csv << csv_row(d);
      });
  ReportInput report{o.before, o.after, comparison, {}};
  if (!o.output.empty()) {
    csv.close();
    if (!csv) throw std::runtime_error((folder / "frames.csv").string() + ": cannot be written");
    ServiceConfig config = o.config.empty() ? ServiceConfig{} : load_service_config(o.config);
    if (!o.key_file.empty()) config.authentication.key_file = o.key_file;
    if (!o.clouds.empty()) report.pictures = draw_worst(comparison, list_logs(o.clouds), config, folder);
    replace_file(folder / "report.md", markdown_report(report));
    replace_file(folder / "report.html", html_report(report));
  } else {
    write_output(markdown_report(report));
  }
  say(app, printed("%lld frames: %lld worse, %lld better, %lld the same to the bit",
                   static_cast<long long>(comparison.frames), static_cast<long long>(comparison.worse),
                   static_cast<long long>(comparison.better), static_cast<long long>(comparison.same)));
  if (comparison.frames == 0) {
    say(app, "no frame was answered by both: these are not runs over the same logs");
    return kExitFailed;
  }
  const double share = static_cast<double>(comparison.worse) / static_cast<double>(comparison.frames);
  return share > o.max_worse ? kExitFailed : kExitOk;
}

}  // namespace
}  // namespace graspd

int main(int argc, char** argv) {
  using namespace graspd;
  CLI::App app("Compares the handle lists of two runs over the same clouds: what got worse, and where.",
               "graspd-compare");
  Options options;
  add_options(app, options);
  return run_program(app, argc, argv, [&] { return compare(app, options); });
}

// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/replay/run_command.hpp"

#include <algorithm>
#include <thread>

#include "client/common/program.hpp"
#include "client/log/log_parts.hpp"
#include "client/replay/effective_config.hpp"
#include "client/replay/reading.hpp"
#include "client/replay/replay_run.hpp"
#include "client/table/handle_tables.hpp"

namespace graspd {

void add_run_options(CLI::App& app, RunOptions& o) {
  app.add_option(
         "logs", o.logs,
         "event logs, in order; the name of a rotated log stands for its parts, a folder for its logs")
      ->required();
  app.add_option("-o,--output", o.output, "event log of the handle lists")->required();
  app.add_option("--config", o.config, "the daemon's configuration (default: its defaults)");
  app.add_option("--gripper", o.gripper, "name of an installed gripper, or a gripper file, for all sources");
  app.add_option("--key", o.key_file,
                 "opens signed clouds (sealed_t), however old they are; only signed ones are taken then");
  app.add_option("--keep", o.keep,
                 "original channels that go into the output too: a regular expression for the whole name; "
                 "channels that the handle lists go to are never kept");
  app.add_option("--from", o.from,
                 "from this time on: seconds since the first event, or @seconds since 1970");
  app.add_option("--to", o.to, "up to this time, exclusive");
  auto* frames =
      app.add_option("--frames", o.frames, "frames A:B, counted from 0, B exclusive; A: and :B work too");
  auto* index = app.add_option("--index", o.places.index_file,
                               "for --frames: where frames are in these logs, written if it is not there");
  index->needs(frames);
  app.add_flag("--scan", o.places.scan,
               "read all headers from the start, instead of looking for times as in logs that are in order")
      ->excludes(index);
  app.add_option(
      "--table", o.table,
      "tables of what was found: FILE.parquet with a row a handle, FILE.frames.parquet with a row a frame");
  app.add_option("--threads", o.threads, "frames in work at the same time; 0: one a core")
      ->check(CLI::Range(0, 256))
      ->capture_default_str();
  app.add_option("--checkpoint", o.checkpoint_s, "what a stopped run loses at most [s]")
      ->check(CLI::Range(0.0, 3600.0))
      ->capture_default_str();
  auto* resume = app.add_flag("--resume", o.resume, "go on with a run that was stopped; the first one too");
  app.add_flag("--overwrite", o.overwrite, "replace an output that exists")->excludes(resume);
  app.add_flag("--times", o.times,
               "stage times and latency as measured; without, they are 0 and equal runs give equal bytes");
}

int replay_threads(int wanted) {
  return wanted > 0 ? wanted : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

int run_command(const CLI::App& app, const RunOptions& o) {
  ReplayConfig config;
  config.service = load_replay_config(o.config, o.gripper, o.key_file);
  for (const auto& log : list_logs(o.logs)) config.parts.push_back({log});
  config.keep = o.keep;
  config.selection = parse_selection(o.from, o.to, o.frames, config.parts);
  for (const std::string& note : find_reading(config, o.places)) say(app, note);
  config.times = o.times;
  config.threads = replay_threads(o.threads);
  config.checkpoint_s = o.checkpoint_s;
  const OldOutput old = o.resume      ? OldOutput::kResume
                        : o.overwrite ? OldOutput::kOverwrite
                                      : OldOutput::kRefuse;
  if (!replay_to(app, config, o.output, old)) return kExitFailed;
  if (!o.table.empty()) (void)write_tables(o.output, o.table);
  return kExitOk;
}

}  // namespace graspd
